extends KnurlDevice
## A game's own device: names of classes, enumerations, signals.

var failures: Array = []


func _ready() -> void:
	contact_started.connect(func(surface: KnurlSurface) -> void: print(surface.name))
	start_failed.connect(func(error: Error, text: String) -> void: failures.append([error, text]))
	if running:
		vibrate(KnurlDevice.VIBRATION_T3, 100.0, 0.5, 0.2, Vector3.UP)
