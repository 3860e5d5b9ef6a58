"""What the user sees: settings, operators, the panel, and the timer that looks after a bake."""

import atexit
import os
import shlex
import shutil
import subprocess
import tempfile
import time

import bpy
from bpy.app.handlers import persistent
from bpy_extras.io_utils import ExportHelper

from . import glb, ground, job, result

MEADOWS = ("meadow", "grass", "hay", "lawn", "daisies", "alpine", "marsh", "prairie", "steppe", "dunes")
PERIOD = 0.2  # [s] between two looks at a bake


class State:
    """The bake that runs, if any, and what the last one said. Names, no data of Blender: an undo replaces those."""

    job = None
    folder = scene = ground = ""
    metres = 1.0
    message = ""  # an error, for the panel
    warnings = ()


class SwardPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    program: bpy.props.StringProperty(
        name="Program sward", subtype="FILE_PATH",
        description="Empty: the sward in PATH. The viewer sward-view is the one beside it, else the one in PATH")

    def draw(self, context):
        self.layout.prop(self, "program")


class SwardSettings(bpy.types.PropertyGroup):
    mask_kind: bpy.props.EnumProperty(
        name="Mask", description="Factor on the density, 0 to 1",
        items=(("NONE", "None", "Grass everywhere"), ("GROUP", "Vertex Group", "Weights of a vertex group"),
               ("ATTRIBUTE", "Attribute", "A float attribute or a channel of a colour attribute")))
    vertex_group: bpy.props.StringProperty(name="Vertex Group")
    attribute: bpy.props.StringProperty(name="Attribute")
    channel: bpy.props.EnumProperty(name="Channel", description="Of a colour",
                                    items=tuple((c, c, "") for c in "RGBA"))
    invert: bpy.props.BoolProperty(name="Invert", description="No grass where the mask is 1")
    meadow: bpy.props.EnumProperty(
        name="Meadow", description="Species that are sown",
        items=(*((name, name.capitalize(), "") for name in MEADOWS), ("FILE", "File…", "A meadow of your own")))
    meadow_file: bpy.props.StringProperty(name="File", subtype="FILE_PATH", description="Meadow as JSON")
    amount: bpy.props.EnumProperty(
        name="Amount", items=(("MEADOW", "Meadow's Own", "What closes the meadow's sward, up to the largest number"),
                              ("DENSITY", "Density", "Blades per square metre"), ("COUNT", "Count", "Number of blades")))
    density: bpy.props.FloatProperty(name="Per m²", default=300.0, min=0.0, soft_max=5000.0)
    count: bpy.props.IntProperty(name="Blades", default=100_000, min=0)
    largest: bpy.props.IntProperty(name="At Most", default=1_000_000, min=1,
                                   description="Largest number of blades; a density or count above it is refused")
    blade_scale: bpy.props.FloatProperty(
        name="Blade Scale", default=1.0, min=1e-6, max=1e5, soft_min=0.1, soft_max=10.0, precision=3,
        description="Size of blades, 1: as in nature. Half as large takes four times as many")
    seed: bpy.props.IntProperty(name="Seed", min=0)
    options: bpy.props.StringProperty(name="Options", description="Further options of sward bake, as --slope 0:40~10")


def program_path(context, name="sward"):
    """Where a program lies. Throws ValueError if it is nowhere."""
    addon = context.preferences.addons.get(__package__)
    wanted = os.path.expanduser(bpy.path.abspath(addon.preferences.program)) if addon else ""
    if name != "sward":
        own = shutil.which(wanted or "sward")
        beside = own and os.path.join(os.path.dirname(os.path.realpath(own)), name)
        found = shutil.which(beside or name) or shutil.which(name)
        wanted = ""
    else:
        found = shutil.which(wanted or name)
    if found is None:
        raise ValueError(f'There is no program "{wanted or name}": install Sward, or name it in the add-on\'s preferences')
    return os.path.abspath(found)


def mask_of(settings):
    if settings.mask_kind == "GROUP":
        return "GROUP", settings.vertex_group
    if settings.mask_kind == "ATTRIBUTE":
        return "ATTRIBUTE", settings.attribute, settings.channel
    return None


def bake_options(settings):
    """Options of `sward bake`. Throws ValueError if the text of further options cannot be split."""
    file = bpy.path.abspath(settings.meadow_file)
    if settings.meadow == "FILE" and not os.path.isfile(file):
        raise ValueError(f'There is no meadow file "{file}"')
    options = ["--meadow", file if settings.meadow == "FILE" else settings.meadow, "--seed", str(settings.seed)]
    if settings.amount == "MEADOW":
        options += ["--budget", str(settings.largest)]
    else:
        wanted = f"{settings.density:.9g}" if settings.amount == "DENSITY" else str(settings.count)
        options += [f"--{settings.amount.lower()}", wanted, "--max-blades", str(settings.largest)]
    if settings.mask_kind != "NONE":
        options += ["--mask", "vertex-color:_SWARD_MASK" + (":invert" if settings.invert else "")]
    try:
        further = shlex.split(settings.options)
    except ValueError as error:
        raise ValueError(f"Options: {error}") from None
    # Without it, sward makes blades smaller and denser on small ground: 632 507 of them on 4 m x 4 m.
    if not any(word.split("=")[0] == "--blade-scale" for word in further):
        options += ["--blade-scale", f"{settings.blade_scale:.6g}"]
    return options + further


def begin(context):
    """Writes the ground and starts the programs. Throws ValueError with a text for the user, and leaves nothing."""
    settings, item = context.scene.sward, context.active_object
    program, options = program_path(context), bake_options(settings)
    base = ground.of_object(context, item, mask_of(settings))
    # Blender removes its temporary folder when it ends. Fields stay until then: an undo brings them back.
    folder = tempfile.mkdtemp(prefix="sward-", dir=bpy.app.tempdir)
    try:
        glb.write_ground(os.path.join(folder, "ground.glb"), base)
        State.job = job.Job(folder, [
            [program, "bake", "ground.glb", "-o", "field.sward", "--progress", "always", *options],
            [program, "export", "field.sward", "-o", "blades.glb", "--progress", "always"]])
    except (OSError, ValueError) as error:
        shutil.rmtree(folder, ignore_errors=True)
        raise ValueError(str(error)) from None
    State.folder, State.scene, State.ground = folder, context.scene.name, item.name
    State.metres = ground.metres_per_unit(context.scene)
    State.message, State.warnings = "", ()


def advance():
    """Looks at the bake; makes its result when it is through. Returns whether it goes on. Main thread only."""
    if State.job is None:
        return False
    if bpy.app.is_job_running("RENDER"):
        return True  # no data changes under a render
    word = State.job.poll()
    if word == "RUNNING":
        return True
    State.message, State.warnings = State.job.error, tuple(State.job.warnings)
    if word == "DONE":
        try:
            finish()
        except Exception as error:  # of any kind: the user reads it in the panel
            State.message = f"The field cannot be shown: {error}"
    if State.message:
        State.job.stop()
    State.job = None
    return False


def finish():
    scene = bpy.data.scenes.get(State.scene) or bpy.context.scene
    path = os.path.join(State.folder, "blades.glb")
    result.build(scene, State.ground, os.path.join(State.folder, "field.sward"), glb.read_blades(path), State.metres)
    for name in ("blades.glb", "ground.glb", "log.txt"):
        os.remove(os.path.join(State.folder, name))
    if not bpy.app.background:
        bpy.ops.ed.undo_push(message="Bake Grass")


def cancel():
    """Ends the bake that runs and leaves nothing of it."""
    if State.job is not None:
        State.job.stop()
        State.job = None


def tick():
    goes_on = advance()
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()
    return PERIOD if goes_on else None


@persistent
def before_load(*_):
    cancel()
    State.message, State.warnings = "", ()


class SWARD_OT_bake(bpy.types.Operator):
    """Grow grass on the active object; Blender goes on meanwhile"""

    bl_idname = "sward.bake"
    bl_label = "Bake"
    wait: bpy.props.BoolProperty(options={"HIDDEN", "SKIP_SAVE"}, description="Return when it is done, for scripts")

    @classmethod
    def poll(cls, context):
        return State.job is None

    def execute(self, context):
        try:
            begin(context)
        except ValueError as error:
            State.message, State.warnings = str(error), ()
            self.report({"ERROR"}, State.message)
            return {"CANCELLED"}
        if not self.wait:
            bpy.app.timers.register(tick, first_interval=PERIOD)
            return {"FINISHED"}
        while advance():
            time.sleep(0.01)
        if State.message:
            self.report({"ERROR"}, State.message)
            return {"CANCELLED"}
        return {"FINISHED"}


class SWARD_OT_cancel(bpy.types.Operator):
    """End the bake that runs"""

    bl_idname = "sward.cancel"
    bl_label = "Cancel"

    @classmethod
    def poll(cls, context):
        return State.job is not None

    def execute(self, context):
        cancel()
        return {"FINISHED"}


def field_path(context):
    """The field file of the active object. Throws ValueError if there is none."""
    collection = result.field_of(context.active_object)
    if collection is None:
        raise ValueError("The active object has no field: bake one")
    if not os.path.isfile(collection[result.FIELD]):
        raise ValueError("The field file is gone, as Blender was closed since: bake again")
    return collection[result.FIELD]


class SWARD_OT_view(bpy.types.Operator):
    """Show the field of the active object in sward-view"""

    bl_idname = "sward.view"
    bl_label = "Show in Viewer"

    def execute(self, context):
        try:
            command = [program_path(context, "sward-view"), field_path(context)]
            subprocess.Popen(command, stdin=subprocess.DEVNULL, start_new_session=True)
        except (OSError, ValueError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


class SWARD_OT_save(bpy.types.Operator, ExportHelper):
    """Save the field of the active object as a file"""

    bl_idname = "sward.save"
    bl_label = "Save Field…"
    filename_ext = ".sward"
    filter_glob: bpy.props.StringProperty(default="*.sward", options={"HIDDEN"})

    def execute(self, context):
        temporary = f"{self.filepath}.{os.getpid()}.tmp"
        try:
            shutil.copyfile(field_path(context), temporary)
            os.replace(temporary, self.filepath)
        except (OSError, ValueError) as error:
            if os.path.exists(temporary):
                os.remove(temporary)
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


class SWARD_PT_panel(bpy.types.Panel):
    bl_label = "Sward"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Sward"

    def draw(self, context):
        layout, settings, item = self.layout, context.scene.sward, context.active_object
        layout.use_property_split = True
        layout.use_property_decorate = False
        layout.label(text=item.name if item else "No active object", icon="MESH_DATA")
        layout.prop(settings, "mask_kind")
        if item is not None and item.type == "MESH" and settings.mask_kind != "NONE":
            if settings.mask_kind == "GROUP":
                layout.prop_search(settings, "vertex_group", item, "vertex_groups")
            else:
                layout.prop_search(settings, "attribute", item.data, "attributes")
                layout.prop(settings, "channel")
            layout.prop(settings, "invert")
        layout.prop(settings, "meadow")
        if settings.meadow == "FILE":
            layout.prop(settings, "meadow_file")
        layout.prop(settings, "amount")
        if settings.amount != "MEADOW":
            layout.prop(settings, settings.amount.lower())
        for name in ("largest", "blade_scale", "seed", "options"):
            layout.prop(settings, name)
        if State.job is None:
            layout.operator("sward.bake", icon="PLAY")
        else:
            layout.label(text=f"{State.ground}: {State.job.step or 'begins'}", icon="TIME")
            layout.operator("sward.cancel", icon="CANCEL")
        say(layout, State.message, "ERROR", context.region.width)
        for text in State.warnings:
            say(layout, text, "INFO", context.region.width)
        draw_field(layout, result.field_of(item))


def draw_field(layout, collection):
    if collection is None:
        return
    layout.separator()
    layout.label(text=f"{collection[result.BLADES]:,} blades on {collection[result.GROUND]}")
    for item in collection.objects:
        modifier = item.modifiers.get("Blades")
        if modifier is not None and modifier.node_group is not None:
            key = result.input_key(modifier, "Viewport share")
            layout.prop(modifier, f'["{key}"]', text="Viewport Share")
    layout.operator("sward.view", icon="HIDE_OFF")
    layout.operator("sward.save", icon="FILE_TICK")


def say(layout, text, icon, width):
    """A text in as many lines as it takes; a letter is about 7 pixels wide."""
    room, line = max(20, width // 7 - 4), ""
    words = text.split()
    for number, word in enumerate(words):
        line = f"{line} {word}".strip()
        if number + 1 == len(words) or len(line) + len(words[number + 1]) >= room:
            layout.label(text=line, icon=icon)
            line, icon = "", "BLANK1"


CLASSES = (SwardPreferences, SwardSettings, SWARD_OT_bake, SWARD_OT_cancel, SWARD_OT_view, SWARD_OT_save, SWARD_PT_panel)


def register():
    """May be called twice."""
    for each in CLASSES:
        if not each.is_registered:
            bpy.utils.register_class(each)
    bpy.types.Scene.sward = bpy.props.PointerProperty(type=SwardSettings)
    if before_load not in bpy.app.handlers.load_pre:
        bpy.app.handlers.load_pre.append(before_load)
    atexit.unregister(cancel)
    atexit.register(cancel)


def unregister():
    """May be called twice. Ends a bake that runs; results stay."""
    cancel()
    atexit.unregister(cancel)
    if bpy.app.timers.is_registered(tick):
        bpy.app.timers.unregister(tick)
    if before_load in bpy.app.handlers.load_pre:
        bpy.app.handlers.load_pre.remove(before_load)
    if hasattr(bpy.types.Scene, "sward"):
        del bpy.types.Scene.sward
    for each in reversed(CLASSES):
        if each.is_registered:
            bpy.utils.unregister_class(each)
