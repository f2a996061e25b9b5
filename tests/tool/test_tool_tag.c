/* knurl tag: the surfaces afterwards, unchanged other bytes, and errors. SPDX-License-Identifier: MIT */
#include "support/close.h"
#include "tool/plate.h"

static void check_same_bytes(const char *one, const char *other) {
    struct stat a;
    struct stat b;
    assert_int_equal(stat(one, &a), 0);
    assert_int_equal(stat(other, &b), 0);
    assert_int_equal(a.st_size, b.st_size);
    char *left = read_file(one);
    char *right = read_file(other);
    assert_memory_equal(left, right, (size_t)a.st_size);
    free(left);
    free(right);
}

static void check_tagged(const char *path, const char *tag) {
    SCOPED_PROCESS p = RUN_TOOL("tag", path, "--list");
    check_done(&p);
    if (!strstr(p.out, tag)) {
        fail_msg("expected %s in %s", tag, p.out);
    }
}

TEST(lengths_and_angles_with_units_become_a_tag) {
    const char *out = tool_path("units.gltf");
    SCOPED_PROCESS p = RUN_TOOL("tag", write_plate("plate.gltf", ""), "--ridges", "0.5mm,2mm", "--amplitude", "200um",
                                "--stiffness", "400", "--friction", "0.5", "--damping", "1", "--orientation", "90deg",
                                "--axis", "1,0,0", "--method", "S2", "--smooth", "no", "--out", out);
    check_done(&p);
    check_tagged(out, "\"tag\": {\"version\":1,\"spatial_frequency\":[2000,500],\"amplitude\":0.0002,"
                      "\"orientation\":1.5707963267948966,\"axis\":[1,0,0],\"method\":\"S2\",\"smooth\":false,"
                      "\"stiffness\":400,\"friction\":0.5,\"damping\":1}");
}

TEST(a_preset_makes_an_untagged_file_felt) {
    const char *out = tool_path("preset.gltf");
    SCOPED_PROCESS p = RUN_TOOL("tag", write_plate("plate.gltf", ""), "--preset", "knurl_straight", "--axis", "1,0,0",
                                "--amplitude", "0.1mm", "--out", out);
    check_done(&p);
    SCOPED_PROCESS q = RUN_TOOL("run", out, "--fast", "--seconds", "1");
    check_done(&q);
    assert_true(json_number_of(q.out, "half_cycles_played") > 10.0);
    check_tagged(out, "\"spatial_frequency\":[1000,0],\"amplitude\":0.0001,");
}

TEST(tagging_and_removing_gives_the_same_bytes) {
    const char *out = tool_path("steel.glb");
    SCOPED_PROCESS p = RUN_TOOL("tag", plate, "--material", "steel", "--preset", "zip", "--out", out);
    assert_int_equal(p.exit_code, 0);
    SCOPED_PROCESS q = RUN_TOOL("tag", out, "--material", "3", "--remove", "--in-place");
    check_done(&q);
    check_same_bytes(out, plate);
}

TEST(a_file_in_place_keeps_the_keys_that_are_not_given) {
    const char *file =
        write_plate("place.gltf", "{\"knurl_spatial_frequency\":1000,\"knurl_amplitude\":1e-4,\"knurl_stiffness\":400,"
                                  "\"knurl_axis\":[1,0,0],\"mine\":1}");
    SCOPED_PROCESS p = RUN_TOOL("tag", file, "--stiffness", "300", "--in-place");
    check_done(&p);
    check_tagged(file,
                 "{\"version\":1,\"spatial_frequency\":1000,\"amplitude\":1e-4,\"stiffness\":300,\"axis\":[1,0,0]}");
}

TEST(a_refused_edit_writes_nothing) {
    static const wrong_line table[] = {
        {"tag --list", 2, "expected a .gltf or .glb file"},
        {"tag %T/plain.gltf", 2, "--ridges or a --preset, or else --remove or --list"},
        {"tag %T/plain.gltf --preset zip --remove --out %T/out.gltf", 2, "or else --remove"},
        {"tag %T/plain.gltf --preset zip", 2, "--out FILE, or --in-place"},
        {"tag %T/plain.gltf --list --out %T/out.gltf", 2,
         "--list changes nothing: expected neither --out nor --in-place"},
        {"tag %T/plain.gltf --list --in-place", 2, "--list changes nothing"},
        {"tag %T/plain.gltf --preset zip --out %T/out.obj", 2,
         "--out: expected a name that ends in .gltf or .glb, found '|out.obj'"},
        {"tag %T/plain.gltf --from-texture --from-picture a.png --in-place", 2,
         "one of --from-texture and --from-picture"},
        {"tag %T/plain.gltf --from-texture --ridges 1mm --in-place", 2,
         "--from-texture finds the ridges|expected no --ridges"},
        {"tag %T/plain.gltf --from-picture a.png --in-place", 2,
         "expected its width with --picture-size, such as 40mm"},
        {"tag %T/plain.gltf --from-picture a.png --picture-size 40 --in-place", 2,
         "--picture-size: expected a length with its unit"},
        {"tag %T/plain.gltf --from-picture a.png --picture-size 1mm,2mm,3mm --in-place", 2,
         "--picture-size: expected a width, or"},
        {"tag %T/plain.gltf --from-texture --picture-size 1mm --in-place", 2, "with --from-picture only"},
        {"tag %T/plain.gltf --preset zip --drawing a.svg --in-place", 2,
         "--drawing with --from-texture or --from-picture only"},
        {"tag %T/plain.gltf --preset zip --in-place --out %T/out.gltf", 2, "--out FILE, or --in-place"},
        {"tag %T/plain.gltf --preset zipp --in-place", 2, "unknown material 'zipp', did you mean 'zip'?"},
        {"tag %T/plain.gltf --ridges 1 --in-place", 2, "--ridges: expected|1mm|found '1'"},
        {"tag %T/plain.gltf --ridges 0mm --in-place", 2, "--ridges: expected|found '0mm'"},
        {"tag %T/plain.gltf --ridges 1mm,2mm,3mm --in-place", 2, "--ridges: expected"},
        {"tag %T/plain.gltf --ridges nanmm --in-place", 2, "--ridges: expected"},
        {"tag %T/plain.gltf --amplitude 0.2 --in-place", 2, "--amplitude: expected a length with its unit|found '0.2'"},
        {"tag %T/plain.gltf --orientation 45 --in-place", 2, "--orientation: expected an angle|'45'"},
        {"tag %T/plain.gltf --axis 1,0 --in-place", 2, "--axis: expected X,Y,Z"},
        {"tag %T/plain.gltf --axis 0,0,-0 --in-place", 2, "--axis: expected X,Y,Z|not all 0, found '0,0,-0'"},
        {"tag %T/plain.gltf --ridges 1e-320m --in-place", 2, "--ridges: expected|found '1e-320m'"},
        {"tag %T/plain.gltf --method S2\n --in-place", 2, "--method: expected a word"},
        {"tag %T/plain.gltf --smooth perhaps --in-place", 2, "--smooth: expected yes or no"},
        {"tag %T/plain.gltf --stiffness -1 --in-place", 2, "--stiffness: expected a number"},
        {"tag %T/plain.gltf --preset zip --amplitude -1mm --out %T/out.gltf", 1,
         "material 'ridges' (0): knurl.amplitude: expected"},
        {"tag %T/plain.gltf --preset zip --method S3 --out %T/out.gltf", 1, "knurl.method: expected 'S1', |found 'S3'"},
        {"tag %T/plain.gltf --ridges 1mm --out %T/out.gltf", 1, "nothing is written|knurl.amplitude: missing"},
        {"tag %T/plain.gltf --material x --node y --preset zip --in-place", 2, "one of --material, --mesh and --node"},
        {"tag %T/plain.gltf --material rdges --preset zip --in-place", 2, "one object 'rdges' in materials, found 0"},
        {"tag %P --preset zip --out %T/out.gltf", 2, "has 5 materials: expected --material"},
        {"tag %T/plain.gltf --preset zip --out %T/none/out.gltf", 1, "plate.bin"},
        {"tag %T/plain.gltf --preset zip --axis 1,0,0 --out %T/plain.gltf", 1, "expected an output of its own"},
        {"tag %T/none.glb --list", 1, "none.glb|cannot be read"},
        {"tag %T --list", 1, "cannot be read: expected a file"},
        {"tag %T/broken.glb --list", 1, "broken.glb: .glb header: expected 12 bytes"},
        {"tag %T/name.gltf --list", 1, "name.gltf: JSON: "},
    };
    (void)write_plate("plain.gltf", "");
    write_text(tool_path("broken.glb"), "glTF");
    write_text(tool_path("name.gltf"), "{\"materials\":[{\"name\":\"\xff\"}]}");
    for (size_t i = 0; i < COUNT_OF(table); i++) {
        check_wrong(&table[i]);
    }
}

TEST(two_objects_of_one_name_are_told_apart_by_index) {
    const char *file = tool_path("twins.gltf");
    write_text(file, "{\"asset\":{\"version\":\"2.0\"},\"materials\":[{\"name\":\"a\"},{\"name\":\"a\"}]}");
    process p = RUN_TOOL("tag", file, "--material", "a", "--preset", "zip", "--in-place");
    check_refused(&p, 2, "expected one object 'a' in materials, found 2; choose one by its index", "twins");
    SCOPED_PROCESS q = RUN_TOOL("tag", file, "--material", "1", "--preset", "zip", "--in-place");
    check_done(&q);
    assert_non_null(strstr(q.err, "no node shows the tagged object"));
    check_tagged(file, "\"index\": 1, \"name\": \"a\", \"tag\": {");
}

TEST(a_listed_tag_is_on_one_line_and_harmless_to_a_terminal) {
    const char *file = tool_path("hostile.gltf");
    write_text(
        file,
        "{\"materials\":[{\"extras\":{\"knurl\":{\"axis\":[1,\n0,\t0],\"method\":\"\xc2\x9b\xe2\x80\xae\\\"S2\"}}}]}");
    check_tagged(file, "\"axis\":[1, 0, 0],\"method\":\"\\u009b\\u202e\\\"S2\"}}]\n");
}

SUITE_FIXTURES(make_folder, remove_folder)
