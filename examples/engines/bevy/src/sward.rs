//! Reads a field of grass (.sward) by Sward's C interface. Knows nothing of Bevy: any program in Rust may use it.

use std::ffi::{CStr, CString};
use std::os::raw::c_char;

/// A row of a field: a blade, the stalk of a compound plant, or a ribbon on a stalk (`sward_blade` of c/field.h).
#[repr(C)]
#[derive(Clone, Copy, Default)]
pub struct Blade {
    pub root: [f64; 3], // [m] world
    pub up: [f32; 3],
    pub facing: f32, // [rad]
    pub height: f32, // [m]
    pub width: f32,  // [m]
    pub stiffness: f32,
    pub exposure: f32,
    pub tint: [f32; 3], // colour of the ground, sRGB
    pub species: u32,
    pub clump: u32,
    pub group: u32,
    pub ribbon: u32, // 0: a blade or a stalk
    pub id: u64,
}

/// `sward_field_info` of c/field.h.
#[repr(C)]
#[derive(Clone, Copy, Default)]
pub struct Info {
    pub blade_count: u64,
    pub patch_count: u64,
    pub species_count: u32,
    pub origin: [f64; 3],
    pub low: [f32; 3],
    pub high: [f32; 3],
}

#[repr(C)]
struct Handle {
    _private: [u8; 0],
}

#[link(name = "sward")]
extern "C" {
    fn sward_field_open(path: *const c_char, field: *mut *mut Handle) -> i32;
    fn sward_field_destroy(field: *mut Handle);
    fn sward_field_get_info(field: *const Handle, info: *mut Info) -> i32;
    fn sward_field_read_blades(field: *const Handle, first: u64, count: u64, blades: *mut Blade) -> i32;
    fn sward_blade_rotation(blade: *const Blade, rotation: *mut f32);
    fn sward_last_error() -> *const c_char;
}

/// A field file, mapped and verified.
pub struct Field {
    handle: *mut Handle,
    pub info: Info,
}

fn check(status: i32) -> Result<(), String> {
    if status == 0 {
        return Ok(());
    }
    Err(unsafe { CStr::from_ptr(sward_last_error()) }.to_string_lossy().into_owned())
}

impl Field {
    /// Sward's message if the file is missing, damaged or of another version.
    pub fn open(path: &str) -> Result<Field, String> {
        let path = CString::new(path).map_err(|_| format!("{path:?} holds a zero"))?;
        let mut field = Field { handle: std::ptr::null_mut(), info: Info::default() };
        check(unsafe { sward_field_open(path.as_ptr(), &mut field.handle) })?;
        check(unsafe { sward_field_get_info(field.handle, &mut field.info) })?;
        Ok(field)
    }

    /// `count` rows from `first` on.
    pub fn blades(&self, first: u64, count: u64) -> Result<Vec<Blade>, String> {
        let mut rows = vec![Blade::default(); count as usize];
        check(unsafe { sward_field_read_blades(self.handle, first, count, rows.as_mut_ptr()) })?;
        Ok(rows)
    }
}

impl Drop for Field {
    fn drop(&mut self) {
        unsafe { sward_field_destroy(self.handle) };
    }
}

impl Blade {
    /// Quaternion x, y, z, w that turns +Y to the up-vector and +Z to the side to which the blade leans.
    pub fn rotation(&self) -> [f32; 4] {
        let mut rotation = [0.0, 0.0, 0.0, 1.0];
        unsafe { sward_blade_rotation(self, rotation.as_mut_ptr()) };
        rotation
    }
}

/// Triangles of many blades: ribbons of three segments, at rest. Places are relative to the field's origin.
#[derive(Default)]
pub struct Ribbons {
    pub positions: Vec<[f32; 3]>,
    pub normals: Vec<[f32; 3]>,
    pub colors: Vec<[f32; 4]>, // linear
    pub indices: Vec<u32>,
}

fn turned(q: [f32; 4], v: [f32; 3]) -> [f32; 3] {
    let t = [
        2.0 * (q[1] * v[2] - q[2] * v[1]),
        2.0 * (q[2] * v[0] - q[0] * v[2]),
        2.0 * (q[0] * v[1] - q[1] * v[0]),
    ];
    [
        v[0] + q[3] * t[0] + q[1] * t[2] - q[2] * t[1],
        v[1] + q[3] * t[1] + q[2] * t[0] - q[0] * t[2],
        v[2] + q[3] * t[2] + q[0] * t[1] - q[1] * t[0],
    ]
}

impl Ribbons {
    /// Adds a blade. Ribbons on stalks are the caller's to leave out.
    pub fn add(&mut self, origin: [f64; 3], blade: &Blade) {
        const RINGS: u32 = 4;
        let rotation = blade.rotation();
        let first = self.positions.len() as u32;
        for i in 0..2 * RINGS - 1 {
            let along = (i / 2) as f32 / (RINGS - 1) as f32;
            let half = if i == 2 * RINGS - 2 { 0.0 } else { 0.5 * blade.width * (1.0 - along * along) };
            let across = if i % 2 == 0 { -half } else { half };
            let point = turned(rotation, [across, along * blade.height, 0.35 * along * along * blade.height]);
            self.positions.push([0, 1, 2].map(|k| (blade.root[k] - origin[k]) as f32 + point[k]));
            let length = (1.0 + 0.49 * along * along).sqrt();
            self.normals.push(turned(rotation, [0.0, -0.7 * along / length, 1.0 / length]));
            let light = 0.25 + 0.75 * along; // less of the sky comes down to the root
            self.colors.push([0.10 * light, 0.22 * light, 0.03 * light, 1.0]);
        }
        for i in 0..2 * RINGS - 3 {
            let (b, c) = if i % 2 == 0 { (1, 2) } else { (2, 1) };
            self.indices.extend([first + i, first + i + b, first + i + c]);
        }
    }
}
