extends Node3D
## Takes a device as soon as one is plugged in, and the mouse (the scene's KnurlMouse) until then.
## retry would wait without the mouse; this asks again every SECONDS instead.

const SECONDS := 2.0

@onready var device: KnurlDevice = $KnurlDevice
@onready var text: Label = $Hud/Text


func _ready() -> void:
	device.stop()
	device.autostart = false
	device.reconnect = false  # a lost device stops, and the mouse takes over
	look()
	var timer := Timer.new()
	timer.wait_time = SECONDS
	timer.timeout.connect(look)
	add_child(timer)
	timer.start()


func look() -> void:
	if device.running and device.device != "mouse":
		return
	var found: String = "mouse"
	var reasons: PackedStringArray = []
	for entry: Dictionary in device.list_devices():
		if entry.usable and entry.device != "fake":
			found = entry.device
		elif not entry.usable:
			reasons.append("%s: %s..." % [entry.name, (entry.reason as String).left(30)])
	if found != device.device or not device.running:
		device.stop()
		device.device = found
		device.start()
	text.text = "Plays with %s.\n%s" % [device.device_name, "\n".join(reasons)]
