//! Shows a field of grass in Bevy: one mesh for some thousand blades, so that Bevy culls them together. Blades stand
//! still, stalks of compound plants are drawn without leaves.
//!
//!     SWARD_LIBRARY_FOLDER=/opt/sward/lib cargo run --release -- meadow.sward

mod sward;

use bevy::asset::RenderAssetUsages;
use bevy::prelude::*;
use bevy::render::mesh::{Indices, PrimitiveTopology};

/// Patches follow one another along the ground, so consecutive blades are neighbours.
const BLADES_OF_A_MESH: u64 = 8192;

fn setup(
    mut commands: Commands,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
) {
    let path = std::env::args().nth(1).expect("usage: sward_bevy FIELD.sward");
    let field = sward::Field::open(&path).unwrap_or_else(|message| panic!("{message}"));
    let material = materials.add(StandardMaterial {
        double_sided: true,
        cull_mode: None,
        perceptual_roughness: 0.7,
        ..default()
    });
    let mut first = 0;
    while first < field.info.blade_count {
        let count = BLADES_OF_A_MESH.min(field.info.blade_count - first);
        let mut ribbons = sward::Ribbons::default();
        for blade in field.blades(first, count).unwrap_or_else(|message| panic!("{message}")) {
            if blade.ribbon == 0 {
                ribbons.add(field.info.origin, &blade);
            }
        }
        let mesh = Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::RENDER_WORLD)
            .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, ribbons.positions)
            .with_inserted_attribute(Mesh::ATTRIBUTE_NORMAL, ribbons.normals)
            .with_inserted_attribute(Mesh::ATTRIBUTE_COLOR, ribbons.colors)
            .with_inserted_indices(Indices::U32(ribbons.indices));
        commands.spawn((Mesh3d(meshes.add(mesh)), MeshMaterial3d(material.clone())));
        first += count;
    }
    let low = Vec3::from(field.info.low);
    let high = Vec3::from(field.info.high);
    let middle = 0.5 * (low + high);
    commands.spawn((
        Camera3d::default(),
        Transform::from_translation(middle + Vec3::new(0.0, 2.0, 0.5 * (high.z - low.z))).looking_at(middle, Vec3::Y),
    ));
    commands.spawn((
        DirectionalLight { shadows_enabled: true, ..default() },
        Transform::from_xyz(1.0, 2.0, 1.0).looking_at(Vec3::ZERO, Vec3::Y),
    ));
}

fn main() {
    App::new().add_plugins(DefaultPlugins).add_systems(Startup, setup).run();
}
