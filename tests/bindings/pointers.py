"""Writes the table of test_pointers.c: every function of the public headers with valid arguments for each of its
parameters, so that the test can put a bad pointer in the place of each in turn. A function whose parameters it knows no
valid argument for is an error here: add one below. SPDX-License-Identifier: MIT

usage: pointers.py OUTPUT HEADER...
"""
import re
import sys

HANDLES = ("scene", "device", "loop", "session", "audio")

# Valid arguments, as members of the test's fixture `f`: by function and parameter, otherwise by parameter and type.
VALUES = {
    "knurl_fail.code": "KNURL_ERROR_STATE",
    "knurl_fail.format": '"why"',
    "knurl_device_open.uri": '"fake"',
    "knurl_device_list.capacity": "1",
    "knurl_gltf_load_file.path": "KNURL_TEST_ASSETS \"/plate_1d.glb\"",
    "knurl_gltf_load_memory.data": "f->file",
    "knurl_gltf_list_tags.data": "f->file",
    "knurl_gltf_set_tag.data": "f->file",
    "knurl_gltf_read_textures.data": "f->file",
    "knurl_gltf_read_textures.size": "f->file_size",
    "knurl_gltf_read_textures.name": '"plate"',
    "knurl_gltf_read_textures.folder": '"."',
    "knurl_gltf_read_textures.user": "f",
    "knurl_gltf_list_tags.size": "f->file_size",
    "knurl_gltf_set_tag.size": "f->file_size",
    "knurl_gltf_list_tags.name": '"plate"',
    "knurl_gltf_set_tag.name": '"plate"',
    "knurl_gltf_list_tags.user": "f",
    "knurl_gltf_set_tag.user": "f",
    "knurl_gltf_load_memory.size": "f->file_size",
    "knurl_gltf_load_memory.name": '"plate"',
    "knurl_gltf_load_memory.folder": '"."',
    "knurl_method_from_name.name": '"S1"',
    "knurl_method_add.name": '"mine"',
    "knurl_method_add.crest": "1.0",
    "knurl_method_add.height": "no_height",
    "knurl_method_add.user": "f",
    "knurl_stroke_from_name.name": '"line"',
    "knurl_scene_find_surface.name": '"plate"',
    "knurl_scene_get_surface_name.name": "f->text",
    "knurl_scene_commit.scene": "f->open_scene",
    "knurl_scene_get_contacts.contacts": "f->contacts",
    "knurl_scene_get_contacts.capacity": "1",
    "radius double": "1.0",
    "knurl_scene_tick_batch.count": "1",
    "knurl_scene_find_closest_batch.count": "1",
    "knurl_scene_set_gains.count": "0",
    "knurl_scene_set_effects.count": "0",
    "kind int32_t": "KNURL_EFFECT_SPRING",
    "effect knurl_effect *": "&f->effect",
    "effects const knurl_effect *": "&f->effect",
    "gains knurl_gain *": "f->gains",
    "knurl_gains_from_response.file": r'"# knurl response 1\nfrequency_hz,gain\n20,1\n400,1\n"',
    "knurl_gains_from_response.size": "48",
    "mass double": "0.045",
    "viscous double": "0.5",
    "knurl_session_start.session": "f->open_session",
    "knurl_session_play.session": "f->open_session",
    "knurl_session_move_hip.session": "f->mouse_session",
    "knurl_session_get_device.session": "f->open_session",
    "knurl_session_get_loop.session": "f->played_session",
    "knurl_session_explain.session": "f->open_session",
    "knurl_session_explain.surface": "f->session_surface",
    "knurl_session_move_surface.session": "f->open_session",
    "knurl_session_move_surface.surface": "f->session_surface",
    "knurl_session_move_workspace.session": "f->played_session",
    "knurl_session_set_force.session": "f->played_session",
    "knurl_session_set_clutch.session": "f->played_session",
    "knurl_session_set_clutch.on": "1",
    "knurl_session_vibrate.session": "f->played_session",
    "knurl_session_vibrate.method": "KNURL_WAVE_T3",
    "knurl_session_vibrate.direction": "f->axis",
    "knurl_session_get_state.session": "f->played_session",
    "knurl_session_get_history.session": "f->played_session",
    "knurl_session_next_event.session": "f->played_session",
    "knurl_session_update.session": "f->played_session",
    "knurl_audio_take.audio": "f->audio",
    "rumble double *": "f->out",
    "knurl_audio_fill.samples": "f->history",
    "knurl_audio_fill.count": "1",
    "knurl_audio_create.audio": "&f->new_audio",
    "knurl_session_get_sound.session": "f->played_session",
    "knurl_session_get_sound.sample_rate_hz": "48000.0",
    "knurl_session_get_sound.sound": "&f->sound",
    "knurl_sound_fill.sound": "f->sound",
    "knurl_sound_fill.samples": "f->history",
    "knurl_sound_fill.count": "1",
    "knurl_sound_get_rumble.sound": "f->sound",
    "knurl_sound_get_rumble.rumble": "f->vector",
    "knurl_sound_release.sound": "f->sound",
    "knurl_wave_prepare.method": "KNURL_WAVE_T3",
    "knurl_loop_vibrate.method": "KNURL_WAVE_T3",
    "knurl_loop_vibrate.direction": "f->axis",
    "knurl_loop_vibrate.loop": "knurl_session_get_loop(f->played_session)",
    "knurl_loop_set_force.loop": "knurl_session_get_loop(f->played_session)",
    "knurl_velocity_prepare.method": "KNURL_VELOCITY_AUTO",
    "knurl_fake_set_trace.rows": "f->rows",
    "knurl_session_play.rows": "f->rows",
    "knurl_session_play.forces": "f->forces",
    "knurl_session_play.played": "&f->count",
    "knurl_session_get_history.rows": "f->history",
    "knurl_session_get_history.count": "1",
    "knurl_device_open.device": "&f->new_device",
    "knurl_device_open_functions.device": "&f->new_device",
    "knurl_loop_create.loop": "&f->new_loop",
    "knurl_scene_create.scene": "&f->new_scene",
    "knurl_session_create.session": "&f->new_session",
    "knurl_scene_add_surface.surface": "&f->new_surface",
    "knurl_scene_find_surface.surface": "&f->new_surface",
    "method const char *": '"S1"',
    "method int32_t *": "&f->number",
    "method int32_t": "KNURL_METHOD_S1",
    "stroke int32_t *": "&f->number",
    "surface knurl_surface_id": "f->surface",
    "hip uint32_t": "0",
    "clock uint32_t": "0",
    "index uint32_t": "0",
    "index int32_t": "0",
    "tick uint64_t": "0",
    "ticks uint64_t": "4",
    "row_count uint64_t": "2",
    "code int32_t": "1",
    "result knurl_result": "0",
    "faults_recover uint32_t": "0",
    "seconds double": "0.0",
    "gain double": "1.0",
    "frequency_hz double": "100.0",
    "stroke int32_t": "KNURL_STROKE_LINE",
    "paused uint32_t": "1",
    "value double": "1.0",
    "resolution double": "0.0",
    "update_rate_hz double": "1000.0",
    "period_s double": "0.01",
    "period_ticks double": "5.0",
    "amplitude double": "1e-4",
    "position double": "1e-4",
    "spatial_frequency double": "1000.0",
    "rotation const double *": "f->quaternion",
    "matrix const double *": "f->matrix",
    "out double *": "f->out",
    "warning char *": "f->text",
    "text char *": "f->text",
    "to char *": "f->text",
    "size size_t": "sizeof f->text",
    "from const char *": '"text"',
    "array const char *": '"materials"',
    "tag const char *": '"{}"',
    "each knurl_gltf_list_callback": "ignore_tag",
    "each knurl_gltf_texture_callback": "ignore_texture",
    "write knurl_gltf_write_callback": "ignore_file",
}

# Parameters that may be null, each for a reason that its function's comment gives.
MAY_BE_NULL = {
    "knurl_device_close.device", "knurl_loop_destroy.loop", "knurl_scene_destroy.scene", "knurl_session_destroy.session",
    "knurl_audio_destroy.audio", "knurl_sound_release.sound", "knurl_audio_create.desc",
    "knurl_scene_create.desc", "knurl_scene_configure_hip.desc",  # all defaults
    "knurl_scene_set_gains.gains", "knurl_scene_set_effects.effects",  # off
    "knurl_fail.format", "knurl_device_list.listings", "knurl_scene_add_surface.surface",
    "knurl_scene_get_tick.output", "knurl_scene_get_tick.counts", "knurl_scene_get_contacts.contacts",
    "knurl_method_add.user",
    "knurl_gltf_load_file.options", "knurl_gltf_load_file.report", "knurl_fake_lay_stroke.report", "knurl_gltf_load_memory.options", "knurl_gltf_load_memory.report", "knurl_gltf_load_memory.name",
    "knurl_gltf_load_memory.folder", "knurl_gltf_list_tags.name", "knurl_gltf_list_tags.user", "knurl_gltf_set_tag.user", "knurl_gltf_set_tag.name",
    "knurl_gltf_read_textures.name", "knurl_gltf_read_textures.folder", "knurl_gltf_read_textures.user", "knurl_gltf_set_tag.tag", "knurl_grating_step.position",
    "knurl_session_start.warning", "knurl_session_explain.text", "knurl_session_fault_text.text",
}

# On the haptic path, and therefore without a message if they return no result; the others are marked with
# KNURL_NONBLOCKING.
HAPTIC = {"knurl_device_halt"}


def declarations(text):
    text = re.sub(r"/\*.*?\*/", "", text, flags=re.S)
    text = re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*$", "", text, flags=re.M)
    for match in re.finditer(r"KNURL_API\s+([^;]*);", text):
        yield " ".join(match.group(1).split())


def split(declaration):
    """Its returned type, name, [(type, name)], and whether it may run in a tick."""
    found = re.match(r"(.*?)(\w+)\(([^()]*)\)(.*)$", declaration)
    returned, name, inside, rest = found.groups()
    parameters = []
    for parameter in inside.split(","):
        if parameter.strip() in ("void", "..."):
            continue
        kind, word, array = re.match(r"\s*(.*?)(\w+)(\[\w*\])?$", parameter).groups()
        kind = kind.strip() + (" *" if array else "")
        parameters.append((kind, word))
    return returned.strip(), name, parameters, "KNURL_NONBLOCKING" in rest


def value_of(function, kind, word, parameters):
    base = re.sub(r"\b(const|\*)\b|\*", "", kind.replace("const", "")).strip()
    for key in (f"{function}.{word}", f"{word} {kind}"):
        if key in VALUES:
            return VALUES[key]
    if base in [f"knurl_{handle}" for handle in HANDLES] and kind.count("*") == 1:
        return "f->" + base[len("knurl_"):]
    if kind == "const double *":
        return "f->vector"
    if kind in ("double *",):
        return "f->out"
    if base.startswith("knurl_") and kind.count("*") == 1:
        return "&f->with." + base[len("knurl_"):]
    if (kind, word) == ("uint32_t", "size"):
        of = [k for k, w in parameters if "*" in k][-1]  # of the pointer before it
        of = of.replace("const", "").replace("*", "").strip()
        return "sizeof f->text" if of == "char" else f"sizeof({of})"
    raise SystemExit(f"pointers.py: {function}: no valid argument is known for {word} ({kind}): add one to VALUES")


def row_of(function, returned, parameters, in_tick):
    fill, call, names = [], [], []
    for kind, word in parameters:
        value = value_of(function, kind, word, parameters)
        if "*" not in kind:
            call.append(value)
            continue
        handle = re.match(r"(?:const )?knurl_(\w+) \*$", kind)
        handle = handle and handle.group(1) in HANDLES and handle.group(1)
        fill.append(f"p[{len(names)}] = (void *)(uintptr_t)({value});")
        call.append(f"({kind})p[{len(names)}]")
        optional = f"{function}.{word}" in MAY_BE_NULL
        names.append(f'{{"{word}", {"KIND_" + handle.upper() if handle else "0"}, {int(optional)}}}')
    returns = {"knurl_result": "RETURNS_RESULT", "void": "RETURNS_NOTHING"}.get(returned, "RETURNS_VALUE")
    said = f"{function}({', '.join(call)})"
    if returned == "void":
        body = f"{said}; return 0;"
    elif returned == "double":
        body = f"return {said} != 0.0;"
    elif "*" in returned:
        body = f"return {said} != NULL;"
    else:
        body = f"return (int64_t){said};"
    thunk = (f"static void fill_{function}(fixture *f, void **p) {{ (void)f; (void)p; {' '.join(fill)} }}\n"
             f"static int64_t call_{function}(fixture *f, void **p) {{ (void)f; (void)p; {body} }}\n")
    quiet = in_tick or function in HAPTIC
    row = (f'    {{"{function}", {returns}, {int(quiet)}, {len(names)}, {{{", ".join(names) or "{NULL, 0, 0}"}}}, '
           f"fill_{function}, call_{function}}},\n")
    return thunk, row


def structs_of(functions):
    """The library's structs that parameters point to, each with its function that fills in defaults, or None."""
    initial = {parameters[0][0]: name for _, name, parameters, _ in functions
               if name.endswith("_init") and [word for _, word in parameters][1:] == ["size"]}
    found = {}
    for _, _, parameters, _ in functions:
        for kind, _ in parameters:
            name = kind.replace("const ", "")
            base = re.match(r"knurl_(\w+) \*$", name)
            if base and base.group(1) not in HANDLES + ("surface", "sound"):
                found[base.group(1)] = initial.get(name)
    return found


def main(output, headers):
    functions = []
    for header in headers:
        with open(header, encoding="utf-8") as file:
            functions += [split(declaration) for declaration in declarations(file.read())]
    structs = structs_of(functions)
    made = [row_of(name, returned, parameters, in_tick) for returned, name, parameters, in_tick in functions]
    with open(output, "w", encoding="utf-8") as file:
        file.write("/* Written by pointers.py. */\n/* NOLINTBEGIN */\n#ifndef FUNCTIONS\ntypedef struct structs {\n")
        file.writelines(f"    knurl_{base} {base};\n" for base in structs)
        file.write("} structs;\n\nstatic void init_structs(structs *s) {\n    memset(s, 0, sizeof *s);\n")
        file.writelines(f"    {init}(&s->{base}, sizeof s->{base});\n" for base, init in structs.items() if init)
        file.write("}\n#else\n" + "".join(thunk for thunk, _ in made))
        file.write("static const function functions[] = {\n" + "".join(row for _, row in made) + "};\n#endif\n/* NOLINTEND */\n")


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
