extends Camera3D
## A camera that flies: W A S D, Q and E for down and up, Shift for faster, and the right mouse button to look around.

@export_range(0.1, 50.0, 0.1, "or_greater", "suffix:m/s") var speed := 4.0


func _process(delta: float) -> void:
	var way := Vector3.ZERO
	for key: Array in [[KEY_W, Vector3.FORWARD], [KEY_S, Vector3.BACK], [KEY_A, Vector3.LEFT], [KEY_D, Vector3.RIGHT], [KEY_Q, Vector3.DOWN], [KEY_E, Vector3.UP]]:
		if Input.is_physical_key_pressed(key[0]):
			way += key[1]
	var times := 4.0 if Input.is_physical_key_pressed(KEY_SHIFT) else 1.0
	translate_object_local(way.normalized() * speed * times * delta)


func _unhandled_input(event: InputEvent) -> void:
	if event is InputEventMouseMotion and Input.is_mouse_button_pressed(MOUSE_BUTTON_RIGHT):
		rotation.y -= 0.004 * event.relative.x
		rotation.x = clampf(rotation.x - 0.004 * event.relative.y, -1.5, 1.5)
