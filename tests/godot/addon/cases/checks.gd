extends RefCounted
## Counts passed and failed checks; the driver reads the last line.

var passed := 0
var failed := 0


func check(holds: bool, sentence: String) -> void:
	if holds:
		passed += 1
	else:
		failed += 1
		print("FAILED: ", sentence)


func equal(found: Variant, expected: Variant, sentence: String) -> void:
	check(found == expected, "%s: expected %s, found %s" % [sentence, expected, found])


func close(found: float, expected: float, tolerance: float, sentence: String) -> void:
	check(
		absf(found - expected) <= tolerance,
		"%s: expected %s, found %s" % [sentence, expected, found]
	)


func finish(tree: SceneTree) -> void:
	print("%d passed, %d failed" % [passed, failed])
	tree.quit(0 if failed == 0 else 1)
