#include "golden/scenes.h"

namespace sward::golden {

namespace {

// The compound plants of a meadow, as many of each species, large and close; grasses are left out.
Scene plantsOf(const std::string& meadow, const std::string& scale,
               const std::vector<std::string>& plants, const std::vector<std::string>& grasses)
{
    Scene scene{"plants_" + meadow,
                {"plane", "--meadow", meadow, "--count", "400", "--blade-scale", scale},
                {"--camera", "CAMERAS/plants.json"}};
    for (const std::string& plant : plants)
        scene.bake.insert(scene.bake.end(), {"--set", "species." + plant + ".share=1"});
    for (const std::string& grass : grasses)
        scene.bake.insert(scene.bake.end(), {"--set", "species." + grass + ".share=1e-6"});
    return scene;
}

} // namespace

// At most 10 000 blades each: lavapipe draws them on the CPU. They are oversized, so that few
// blades cover the ground and are wider than a pixel.
const std::vector<Scene>& scenes()
{
    static const std::vector<Scene> all{
        // Grass along the surface normal, in any direction.
        {"sphere", {"sphere", "--count", "8000", "--blade-scale", "4"}, {"--camera", "fit"}},
        {"hills_tessellated",
         {"hills", "--count", "10000", "--blade-scale", "4"},
         {"--camera", "eye", "--geometry", "tessellation"}},
        {"hills_eye", {"hills", "--count", "10000", "--blade-scale", "4"}, {"--camera", "eye"}},
        {"hills_for_cpu_4",
         {"hills", "--count", "10000", "--blade-scale", "4"},
         {"--camera", "eye", "--raster-for", "cpu"}},
        {"arch_from_below",
         {"arch", "--count", "8000", "--blade-scale", "2"},
         {"--camera", "CAMERAS/arch_from_below.json"}},

        // A terrain of another program: textures, several nodes, a painted mask.
        {"landscape",
         {"MESHES/landscape.glb", "--count", "10000", "--blade-scale", "6", "--mask",
          "vertex-color:R:or-white"},
         {"--camera", "fit"}},

        // A second of wind.
        {"wind_frame_60",
         {"plane", "--count", "5000", "--blade-scale", "4"},
         {"--camera", "edge", "--wind-strength", "6", "--frames", "60:60"}},

        // A ball and a capsule press the grass down.
        {"colliders",
         {"plane", "--count", "10000", "--blade-scale", "4"},
         {"--camera", "top", "--wind-strength", "0", "--collider", "sphere:-2,1,-1,3", "--collider",
          "capsule:-5,0,6,7,0,1,1"}},

        // Compound plants; see furtherScenes(), too.
        plantsOf("hay", "3", {"timothy", "bent", "buttercup", "ox-eye daisy", "sage", "red clover"},
                 {"ryegrass", "fescue"}),
        plantsOf("marsh", "1.6", {"bulrush", "cotton-grass", "marsh marigold", "iris", "fern"},
                 {"sedge", "moor-grass"}),

        // No blades: only ground and sky.
        {"empty", {"plane", "--slope", "45:90", "--density", "10"}, {"--camera", "fit"}},

        // Thinned and widened distant blades.
        {"thinned", {"dunes", "--count", "10000"}, {"--camera", "edge", "--lod", "on"}},

        // Debug colours.
        {"debug_patches",
         {"hills", "--count", "8000", "--blade-scale", "6"},
         {"--camera", "fit", "--debug", "patches"}},
    };
    return all;
}

const std::vector<Scene>& furtherScenes()
{
    static const std::vector<Scene> all{
        {"hills", {"hills", "--count", "10000", "--blade-scale", "6"}, {"--camera", "fit"}},
        {"hills_for_cpu",
         {"hills", "--count", "10000", "--blade-scale", "4"},
         {"--camera", "eye", "--raster-for", "cpu", "--samples", "1"}},
        {"arch", {"arch", "--count", "8000", "--blade-scale", "4"}, {"--camera", "fit"}},

        // The field of wind_frame_60 at rest.
        {"wind_frame_0",
         {"plane", "--count", "5000", "--blade-scale", "4"},
         {"--camera", "edge", "--wind-strength", "6", "--frames", "0:0"}},

        // With those of scenes() every built-in species with organs is in a picture.
        plantsOf("dunes", "2", {"marram in flower"}, {"marram"}),
        plantsOf("daisies", "6",
                 {"clover", "daisy", "white clover flower", "plantain", "dandelion",
                  "dandelion clock", "buttercup"},
                 {"lawn"}),
        plantsOf("alpine", "6", {"arnica", "aster", "gentian", "anemone", "globeflower", "bent"},
                 {"fescue", "mat-grass"}),
        plantsOf("prairie", "2.2",
                 {"switchgrass", "coneflower", "black-eyed susan", "blazing star", "wild rye"},
                 {"bluestem", "little bluestem"}),

        // All blades of the field "thinned".
        {"not_thinned", {"dunes", "--count", "10000"}, {"--camera", "edge", "--lod", "off"}},

        {"debug_wind",
         {"sphere", "--count", "8000", "--blade-scale", "4"},
         {"--camera", "fit", "--debug", "wind", "--frames", "60:60"}},
    };
    return all;
}

} // namespace sward::golden
