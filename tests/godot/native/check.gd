extends Node3D
## Draws a field by SwardGrass3D and says what came of it, in lines that begin with RESULT. User arguments, as --name value:
##   field FILE.sward     what is drawn
##   renderer WORD        auto, native, multimesh
##   frames N             of which the first four are not counted
##   shot FILE.png        picture of the last frame
##   ground FILE.glb      its ground is drawn by Godot
##   eye, target X,Y,Z    of the camera; fov in degrees
##   scenery 0            no balls and no water
##   budget MIB           of the grass
##   settings JSON        of the grass; shadows 1: blades cast shadows
##   case plain           nothing changes
##        colliders       a ball rolls through the grass
##        move            the camera moves and turns in each frame
##        views           a second viewport of another camera
##        resize          the window changes its size twice
##        reload          the field is freed and loaded again, twice
##        ortho           the camera is orthogonal
## There is no wind but in the case colliders, so that pictures are equal from run to run.

var args := {"field": "", "renderer": "auto", "case": "plain", "frames": "8", "shot": "", "eye": "0,3,12", "target": "0,0,0",
		"fov": "50", "scenery": "1", "settings": "", "ground": "", "budget": "0"}
var grass: SwardGrass3D
var camera := Camera3D.new()
var ball: MeshInstance3D
var second: SubViewport
var frame := 0
var begun := 0
var last := 0
var times := []
var errors := []


func _ready() -> void:
	var given := OS.get_cmdline_user_args()
	for i in range(0, given.size() - 1, 2):
		args[given[i].trim_prefix("--")] = given[i + 1]
	RenderingServer.viewport_set_measure_render_time(get_viewport().get_viewport_rid(), false)
	DisplayServer.window_set_vsync_mode(DisplayServer.VSYNC_DISABLED)
	camera.fov = float(args.fov)
	add_child(camera)
	camera.look_at_from_position(_vector(args.eye), _vector(args.target))
	if args.case == "ortho":
		camera.projection = Camera3D.PROJECTION_ORTHOGONAL
	var light := DirectionalLight3D.new()
	light.rotation_degrees = Vector3(-40, 40, 0)
	light.shadow_enabled = false
	add_child(light)
	var world := WorldEnvironment.new()
	world.environment = Environment.new()
	world.environment.background_mode = Environment.BG_COLOR
	world.environment.background_color = Color(0.55, 0.7, 0.9)
	world.environment.ambient_light_source = Environment.AMBIENT_SOURCE_COLOR
	world.environment.ambient_light_color = Color(0.55, 0.6, 0.7)
	world.environment.ambient_light_energy = 0.6
	add_child(world)
	if args.scenery == "1":
		_add_scenery()
	if args.ground:
		add_child(preload("ground.gd").load_from(args.ground))
	grass = SwardGrass3D.new()
	grass.name = "Grass"
	grass.wind_override = true
	grass.wind_speed = 4.0 if args.case == "colliders" else 0.0
	grass.shadows = args.get("shadows", "0") == "1"
	grass.settings = args.settings
	grass.budget = int(args.budget)
	grass.renderer = {"auto": SwardGrass3D.Renderer.AUTO, "native": SwardGrass3D.Renderer.NATIVE,
			"multimesh": SwardGrass3D.Renderer.MULTIMESH}[args.renderer]
	grass.renderer_chosen.connect(func(renderer: String, reason: String) -> void:
			print("RESULT renderer ", renderer, " after ", (Time.get_ticks_usec() - begun) / 1000, " ms: ", reason))
	grass.field = args.field
	begun = Time.get_ticks_usec()
	last = begun
	add_child(grass)
	if args.case == "colliders":
		grass.colliders = [grass.get_path_to(ball)]
	if args.case == "views":
		second = SubViewport.new()
		second.size = Vector2i(320, 240)
		second.render_target_update_mode = SubViewport.UPDATE_ALWAYS
		var other := Camera3D.new()
		second.add_child(other)
		add_child(second)
		other.look_at_from_position(Vector3(8, 4, 8), Vector3.ZERO)


func _vector(text: String) -> Vector3:
	var parts := text.split_floats(",")
	return Vector3(parts[0], parts[1], parts[2])


func _add_scenery() -> void:
	for k in 3:
		ball = _add(SphereMesh.new(), Color(0.8, 0.1, 0.1))
		ball.position = Vector3(-4 + 4 * k, 0.3, 4 - 3 * k)
		ball.scale = Vector3.ONE * 2.0
	var water := _add(PlaneMesh.new(), Color(0.1, 0.3, 0.6, 0.6))
	water.scale = Vector3.ONE * 20.0
	water.position.y = -0.35
	(water.material_override as StandardMaterial3D).transparency = BaseMaterial3D.TRANSPARENCY_ALPHA
	var soil := _add(PlaneMesh.new(), Color(0.2, 0.16, 0.1))
	soil.scale = Vector3.ONE * 20.0
	soil.position.y = -0.6


func _add(mesh: Mesh, color: Color) -> MeshInstance3D:
	var item := MeshInstance3D.new()
	item.mesh = mesh
	var material := StandardMaterial3D.new()
	material.albedo_color = color
	item.material_override = material
	add_child(item)
	return item


func _process(_delta: float) -> void:
	frame += 1
	var now := Time.get_ticks_usec()
	if frame == 2:
		print("RESULT first frame after ", (now - begun) / 1000, " ms")
	elif frame > 4:
		times.append((now - last) / 1000.0)
	last = now
	var frames := int(args.frames)
	match args.case:
		"move":
			camera.look_at_from_position(Vector3(0.4 * frame - 2.0, 3.0, 12.0 - 0.3 * frame), Vector3(0, 0, -2))
		"colliders":
			ball.position = Vector3(6.0 - 0.25 * frame, 0.4, 6.0)
		"resize":
			if frame == frames / 3:
				get_window().size = Vector2i(480, 270)
			if frame == 2 * frames / 3:
				get_window().size = Vector2i(720, 400)
		"reload":
			if frame == frames / 3:
				remove_child(grass)
			if frame == frames / 2:
				add_child(grass)
			if frame == 2 * frames / 3:
				grass.reload()
	if frame == frames:
		_finish()


func _finish() -> void:
	await RenderingServer.frame_post_draw
	times.sort()
	if times:
		print("RESULT median of ", times.size(), " frames: ", snappedf(times[times.size() / 2], 0.1), " ms")
	print("RESULT ", grass.renderer_in_use, ": ", grass.blade_count(), " blades, ", grass.drawn_blades(), " drawn; window ",
			get_window().size)
	for warning in grass._get_configuration_warnings():
		print("RESULT warning ", warning)
	if args.shot:
		get_viewport().get_texture().get_image().save_png(args.shot)
		if second:
			second.get_texture().get_image().save_png(args.shot.replace(".png", "_second.png"))
	get_tree().quit()
