@tool
extends RefCounted
## A grating's tag in glTF [code]extras[/code], nested or flat: read, checked, merged. Errors are
## worded as in Knurl's own loader: object, key, expected and found value.

const METHODS: Dictionary = {"S1": 1, "S2": 2, "bandlimited": 3}
const KEYS: Array[String] = [
	"version",
	"spatial_frequency",
	"amplitude",
	"stiffness",
	"damping",
	"friction",
	"orientation",
	"axis",
	"coordinates",
	"method",
	"smooth",
]
const REQUIRED: Array[String] = ["spatial_frequency", "amplitude", "stiffness"]
const FLAT_PREFIX := "knurl_"


## The tag of one object, or several merged ones.
class Tag:
	extends RefCounted
	var values: Dictionary = {}
	var broken := false  ## it has an error, already reported

	## Replaces the values of the keys that [param other] has.
	func override_with(other: Tag) -> void:
		if other.values.has("axis"):  # of an axis and a box the later one wins
			values.erase("coordinates")
		if other.values.has("coordinates"):
			values.erase("axis")
		values.merge(other.values, true)
		broken = broken or other.broken

	## The first missing required key, or "".
	func missing_key() -> String:
		for key: String in REQUIRED:
			if not values.has(key):
				return key
		return ""


## The errors, one sentence each.
var errors: PackedStringArray = []

var _where := ""


## The tag of a material, mesh or node of the file's JSON; null if its extras hold no tag.
func read(owner: Dictionary, where: String) -> Tag:
	var extras: Variant = owner.get("extras")
	if not extras is Dictionary:
		return null  # extras may be any value (glTF 2.0, 3.2); only an object can hold a tag
	_where = where
	var nested: bool = extras.has("knurl")
	var flat: Array[String] = _flat_keys(extras)
	if not nested and flat.is_empty():
		return null
	var tag := Tag.new()
	var count: int = errors.size()
	if nested and not flat.is_empty():
		_refuse(
			"extras",
			(
				"holds both an object 'knurl' and flat keys such as '%s': expected one form of the tag"
				% flat[0]
			)
		)
	elif nested:
		_read_nested(tag, extras["knurl"])
	for key: String in flat:
		_read_entry(tag, FLAT_PREFIX, key.trim_prefix(FLAT_PREFIX), extras[key])
	tag.broken = errors.size() > count
	return tag


## Reports a tag on an object that cannot have one, instead of ignoring it silently.
func refuse(owner: Dictionary, where: String, instead: String, at: String = "extras") -> void:
	var extras: Variant = owner.get("extras")
	if extras is Dictionary and (extras.has("knurl") or not _flat_keys(extras).is_empty()):
		_where = where
		_refuse(at, "a knurl tag would be lost here: " + instead)


static func _flat_keys(extras: Dictionary) -> Array[String]:
	var flat: Array[String] = []
	for key: Variant in extras:
		if String(key).begins_with(FLAT_PREFIX):
			flat.append(String(key))
	return flat


func _read_nested(tag: Tag, nested: Variant) -> void:
	if not nested is Dictionary:
		_refuse_value("extras.knurl", "an object", nested)
		return
	if not nested.has("version"):
		_refuse("knurl.version", "missing: expected 1")
	for key: Variant in nested:
		_read_entry(tag, "knurl.", String(key), nested[key])


func _read_entry(tag: Tag, prefix: String, key: String, value: Variant) -> void:
	var at: String = prefix + key
	match key:
		"version":
			if not _is_number(value) or value != 1:
				_refuse_value(at, "1, the version that this library reads", value)
		"spatial_frequency":
			_read_spatial_frequency(tag, at, value)
		"amplitude":
			_read_number(tag, key, at, "a number >= 0 (m)", value, _is_from_0)
		"stiffness":
			_read_number(tag, key, at, "a number > 0 (N/m)", value, _is_positive)
		"damping":
			_read_number(tag, key, at, "a number >= 0 (N s/m)", value, _is_from_0)
		"friction":
			_read_number(tag, key, at, "a number >= 0 (a Coulomb coefficient)", value, _is_from_0)
		"orientation":
			_read_number(tag, key, at, "a number (rad)", value, _is_number)
		"axis":
			_read_axis(tag, at, value)
		"coordinates":
			if value is String and value in ["auto", "box"]:
				tag.values[key] = value
			else:
				_refuse_value(at, "'auto' or 'box'", value)
		"method":
			if not value is String:
				_refuse_value(at, "a string: 'S1', 'S2' or 'bandlimited'", value)
			elif METHODS.has(value):
				tag.values[key] = METHODS[value]
			else:
				_refuse_value(at, "'S1', 'S2' or 'bandlimited'", value)
		"smooth":
			if value is bool or (_is_number(value) and (value == 0 or value == 1)):
				tag.values[key] = bool(value)
			else:
				_refuse_value(at, "true or false", value)
		_:
			_refuse(
				at,
				(
					"unknown key; known are "
					+ ", ".join(KEYS.map(func(name: String) -> String: return prefix + name))
				)
			)


func _read_number(
	tag: Tag, key: String, at: String, expected: String, value: Variant, allowed: Callable
) -> void:
	if allowed.call(value):
		tag.values[key] = float(value)
	else:
		_refuse_value(at, expected, value)


func _read_spatial_frequency(tag: Tag, at: String, value: Variant) -> void:
	if _is_from_0(value):
		tag.values["spatial_frequency"] = Vector2(value, 0.0)
	elif value is Array and value.size() == 2 and value.all(_is_from_0):
		tag.values["spatial_frequency"] = Vector2(value[0], value[1])
	else:
		_refuse_value(at, "a number >= 0 or an array of 2 of them (cycles/m)", value)


func _read_axis(tag: Tag, at: String, value: Variant) -> void:
	if value is Array and value.size() == 3 and value.all(_is_number):
		# Scaled to 1, so that tiny and huge components do not underflow or overflow in a Vector3.
		var largest: float = maxf(absf(value[0]), maxf(absf(value[1]), absf(value[2])))
		if largest > 0.0:
			tag.values["axis"] = Vector3(value[0] / largest, value[1] / largest, value[2] / largest)
			return
	_refuse_value(
		at, "an array of 3 numbers that are not all 0 (a direction in object space)", value
	)


static func _is_number(value: Variant) -> bool:
	return value is int or (value is float and is_finite(value))


static func _is_from_0(value: Variant) -> bool:
	return _is_number(value) and value >= 0


static func _is_positive(value: Variant) -> bool:
	return _is_number(value) and value > 0


func _refuse_value(at: String, expected: String, found: Variant) -> void:
	_refuse(at, "expected %s, found %s" % [expected, JSON.stringify(found).left(80)])


func _refuse(at: String, what: String) -> void:
	errors.append("%s%s: %s" % [_where + ": " if not _where.is_empty() else "", at, what])
