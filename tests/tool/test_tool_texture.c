/* knurl tag --from-texture and --from-picture: the tag against the formula that drew the texture, the ridges under the
 * HIP, and bad pictures. SPDX-License-Identifier: MIT */
#include "drawn.h"
#include "support/close.h"
#include "support/tool.h"

#include <knurl/knurl.h>

#include <jpeglib.h>
#include <png.h>

enum { SIDE = 160 };

/* --- pictures --- */

static uint32_t image_format = PNG_FORMAT_RGB; /* of the next PNG; PNG_FORMAT_RGB_COLORMAP: a palette */

static void write_png(const char *name, const void *pixels, uint32_t width, uint32_t height, const void *palette) {
    png_image image;
    memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    image.width = width;
    image.height = height;
    image.format = image_format;
    image.flags = image_format == PNG_FORMAT_LINEAR_Y ? PNG_IMAGE_FLAG_16BIT_sRGB : 0;
    image.colormap_entries = 256;
    assert_true(png_image_write_to_file(&image, tool_path(name), 0, pixels, 0, palette));
    image_format = PNG_FORMAT_RGB;
}

/* Grey ridges: 0.5 + 0.4 sin. */
static const unsigned char *draw_grey(const drawn_axis *a) {
    static unsigned char rgb[SIDE * SIDE * 3];
    for (int i = 0; i < SIDE * SIDE; i++) {
        const double level = 0.5 + 0.4 * drawn_height(a, i % SIDE + 0.5, i / SIDE + 0.5);
        memset(&rgb[3 * i], (int)lround(255.0 * level), 3);
    }
    return rgb;
}

/* Normals of h = A sin(2 pi f . p), x and y up, with p in metres: `metres` is the picture's width and height. */
static const unsigned char *draw_normals(const drawn_axis *a, double amplitude, const double metres[2]) {
    static unsigned char rgb[SIDE * SIDE * 3];
    const double turn = DRAWN_TURN * a->degrees / 360.0;
    const double k[2] = {DRAWN_TURN * cos(turn) / a->apart * SIDE / metres[0],
                         DRAWN_TURN * sin(turn) / a->apart * SIDE / metres[1]};
    for (int i = 0; i < SIDE * SIDE; i++) {
        const double slope = amplitude * cos(DRAWN_TURN * drawn_phase(a, i % SIDE + 0.5, i / SIDE + 0.5));
        const double n[3] = {-slope * k[0], -slope * k[1], 1.0};
        const double length = sqrt(n[0] * n[0] + n[1] * n[1] + 1.0);
        for (int c = 0; c < 3; c++) {
            rgb[3 * i + c] = (unsigned char)lround(255.0 * (0.5 + 0.5 * n[c] / length));
        }
    }
    return rgb;
}

static void write_jpeg(const char *name, const unsigned char *rgb) {
    struct jpeg_compress_struct jpeg;
    struct jpeg_error_mgr errors;
    FILE *file = fopen(tool_path(name), "wb");
    assert_non_null(file);
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    jpeg_stdio_dest(&jpeg, file);
    jpeg.image_width = jpeg.image_height = SIDE;
    jpeg.input_components = 3;
    jpeg.in_color_space = JCS_RGB;
    jpeg_set_defaults(&jpeg);
    jpeg_start_compress(&jpeg, TRUE);
    for (int y = 0; y < SIDE; y++) {
        JSAMPROW row = (JSAMPROW)&rgb[3 * SIDE * y];
        (void)jpeg_write_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    (void)fclose(file);
}

/* --- a plate with UVs: 0.12 x 0.06 m round the origin, facing +y --- */

/* The picture is 0.06 m wide and 0.03 m high on it: u runs from 0 to 2 along +x, v from 0 to 2 along +z, which is down
 * if seen from the front with x to the right. */
static const double metres[2] = {0.06, 0.03};

/* material: its members; more: other members of the root. scales: 1: a second node shows it twice as large. */
static const char *write_textured(const char *name, const char *material, const char *more, int scales) {
    static const float corners[6][5] = {{-0.06F, 0, -0.03F, 0, 0}, {-0.06F, 0, 0.03F, 0, 2}, {0.06F, 0, 0.03F, 2, 2},
                                        {-0.06F, 0, -0.03F, 0, 0}, {0.06F, 0, 0.03F, 2, 2},  {0.06F, 0, -0.03F, 2, 0}};
    char text[4096];
    (void)snprintf(text, sizeof text,
                   "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0%s]}],"
                   "\"nodes\":[{\"name\":\"plate\",\"mesh\":0},{\"name\":\"large\",\"mesh\":0,\"scale\":[2,2,2],"
                   "\"translation\":[0,0,1]}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,"
                   "\"TEXCOORD_0\":1},\"material\":0}]}],\"materials\":[{\"name\":\"Grip\"%s%s}],"
                   "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":6,\"type\":\"VEC3\"},"
                   "{\"bufferView\":0,\"byteOffset\":12,\"componentType\":5126,\"count\":6,\"type\":\"VEC2\"}],"
                   "\"bufferViews\":[{\"buffer\":0,\"byteLength\":120,\"byteStride\":20}],"
                   "\"buffers\":[{\"uri\":\"plate.bin\",\"byteLength\":120}]%s}",
                   scales ? ",1" : "", material[0] ? "," : "", material, more);
    write_file(tool_path("plate.bin"), corners, sizeof corners);
    write_text(tool_path(name), text);
    return tool_path(name);
}

#define COLOUR      "\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}"
#define ONE_TEXTURE ",\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"t.png\"}]"

static void check_number(const char *json, const char *key, double expected, double tolerance) {
    CHECK_CLOSE(json_number_of(json, key), expected, tolerance);
}

/* --- found --- */

TEST(an_image_file_gives_distances_by_its_size) {
    const drawn_axis a = {8.7, 30.0, DRAWN_SINE};
    write_png("weave.png", draw_grey(&a), SIDE, SIDE, NULL);
    SCOPED_PROCESS p = RUN_TOOL("tag", "--from-picture", tool_path("weave.png"), "--picture-size", "40mm");
    assert_int_equal(p.exit_code, 0);
    check_number(p.out, "apart", 40e-3 / SIDE * 8.7, 0.005e-3);
    check_number(p.out, "direction", DRAWN_TURN / 12.0, 0.005);
    assert_non_null(strstr(p.out, "\"amplitude\": null"));
    assert_non_null(strstr(p.err, "colours have no depth"));
}

TEST(a_height_picture_of_a_given_depth_has_an_amplitude) {
    const drawn_axis a = {8.7, 90.0, DRAWN_SINE};
    static uint16_t heights[SIDE * SIDE];
    for (int i = 0; i < SIDE * SIDE; i++) { /* 16 bits: its swing of 1 in 100 would be 2 steps of 8 bits */
        heights[i] = (uint16_t)lround(65535.0 * (0.5 + 0.005 * drawn_height(&a, i % SIDE, i / SIDE)));
    }
    image_format = PNG_FORMAT_LINEAR_Y;
    write_png("height.png", heights, SIDE, SIDE, NULL);
    SCOPED_PROCESS p = RUN_TOOL("tag", "--from-picture", tool_path("height.png"), "--picture-size", "40mm,20mm",
                                "--picture-depth", "5mm");
    assert_int_equal(p.exit_code, 0);
    check_number(p.out, "apart", 20e-3 / SIDE * 8.7, 0.003e-3);
    check_number(p.out, "amplitude", 0.005 * 5e-3, 0.02 * 0.005 * 5e-3);
}

TEST(palettes_and_jpegs_are_read) {
    const drawn_axis a = {11.0, 45.0, DRAWN_SINE};
    static unsigned char places[SIDE * SIDE], palette[256 * 3];
    const unsigned char *rgb = draw_grey(&a);
    for (int i = 0; i < SIDE * SIDE; i++) {
        places[i] = (unsigned char)(255 - rgb[3 * i]); /* backwards, so that the palette must be looked up */
    }
    for (int i = 0; i < 256; i++) {
        memset(&palette[3 * i], i < 128 ? 255 : 0, 3);
    }
    image_format = PNG_FORMAT_RGB_COLORMAP;
    write_png("palette.png", places, SIDE, SIDE, palette);
    write_jpeg("plain.jpg", rgb);
    const char *const names[] = {"palette.png", "plain.jpg"};
    for (int i = 0; i < 2; i++) {
        SCOPED_PROCESS p = RUN_TOOL("tag", "--from-picture", tool_path(names[i]), "--picture-size", "160mm");
        assert_int_equal(p.exit_code, 0);
        check_number(p.out, "apart", 11e-3, 0.02e-3);
        check_number(p.out, "direction", DRAWN_TURN / 8.0, 0.005);
    }
}

static double cycles_at(knurl_scene *scene, double x, double z) {
    knurl_tick_input in;
    knurl_tick_output out;
    memset(&in, 0, sizeof in);
    in.position[0] = x;
    in.position[1] = -1e-4;
    in.position[2] = z;
    for (int i = 0; i < 3; i++) {
        (void)knurl_scene_tick(scene, 0, &in, &out);
    }
    assert_true(out.surface != 0);
    return out.cycles[0];
}

/* Along the texture's own ridges the phase stays; across them it moves on by one cycle per ridge. The texture's ridges
 * are 20 pixels apart, at 30 degrees in pixels, and its pixels are twice as wide as high on the plate. */
static void check_felt(const char *path, double pixel_x, double pixel_z) {
    SCOPED_SCENE *scene = NULL;
    assert_int_equal(knurl_scene_create(NULL, &scene), KNURL_OK);
    assert_int_equal(knurl_gltf_load_file(scene, path, NULL, NULL), KNURL_OK);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    const double c = cos(DRAWN_TURN / 12.0), s = sin(DRAWN_TURN / 12.0);
    const double here = cycles_at(scene, 0.001, 0.002);
    const double along = cycles_at(scene, 0.001 + 40.0 * s * pixel_x, 0.002 + 40.0 * c * pixel_z);
    const double across = cycles_at(scene, 0.001 + 20.0 * c * pixel_x, 0.002 - 20.0 * s * pixel_z);
    CHECK_CLOSE(along, here, 0.02);
    CHECK_CLOSE(fabs(across - here), 1.0, 0.02);
}

TEST(ridges_are_felt_where_the_texture_has_them) {
    const drawn_axis a = {20.0, 30.0, DRAWN_SQUARE};
    const char *out = tool_path("felt.gltf");
    write_png("t.png", draw_grey(&a), SIDE, SIDE, NULL);
    SCOPED_PROCESS p = RUN_TOOL("tag", write_textured("grip.gltf", COLOUR, ONE_TEXTURE, 0), "--material", "Grip",
                                "--from-texture", "--amplitude", "0.2mm", "--stiffness", "400", "--out", out);
    assert_int_equal(p.exit_code, 0);
    check_felt(out, metres[0] / SIDE, metres[1] / SIDE);
}

/* With KHR_texture_transform, a texture that is scaled by 1/2 is twice as large. */
TEST(a_texture_transform_counts) {
    const drawn_axis a = {10.0, 30.0, DRAWN_SQUARE};
    const char *out = tool_path("felt.gltf");
    write_png("t.png", draw_grey(&a), SIDE, SIDE, NULL);
    const char *file = write_textured("grip.gltf",
                                      "\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0,\"extensions\":{"
                                      "\"KHR_texture_transform\":{\"scale\":[0.5,0.5],\"offset\":[0.1,0.3]}}}}",
                                      ONE_TEXTURE, 0);
    SCOPED_PROCESS p = RUN_TOOL("tag", file, "--from-texture", "--preset", "zip", "--out", out);
    assert_int_equal(p.exit_code, 0);
    check_felt(out, metres[0] / SIDE, metres[1] / SIDE);
}

TEST(a_normal_texture_has_an_amplitude_and_comes_first) {
    const drawn_axis a = {16.0, 0.0, DRAWN_SINE}, other = {9.0, 0.0, DRAWN_SINE};
    write_png("t.png", draw_grey(&other), SIDE, SIDE, NULL);
    write_png("n.png", draw_normals(&a, 0.3e-3, metres), SIDE, SIDE, NULL);
    const char *file = write_textured("grip.gltf", COLOUR ",\"normalTexture\":{\"index\":1,\"scale\":0.5}",
                                      ",\"textures\":[{\"source\":0},{\"source\":1}],"
                                      "\"images\":[{\"uri\":\"t.png\"},{\"uri\":\"n.png\"}]",
                                      0);
    SCOPED_PROCESS p = RUN_TOOL("tag", file, "--from-texture");
    assert_int_equal(p.exit_code, 0);
    assert_non_null(strstr(p.out, "\"read_as\": \"normal\""));
    check_number(p.out, "apart", 16.0 * metres[0] / SIDE, 0.01e-3);
    check_number(p.out, "amplitude", 0.15e-3, 0.004e-3); /* half, by the texture's scale */
}

TEST(a_drawing_shows_picture_and_spectrum) {
    const drawn_axis a = {11.0, 45.0, DRAWN_SINE};
    write_png("t.png", draw_grey(&a), SIDE, SIDE, NULL);
    SCOPED_PROCESS p = RUN_TOOL("tag", "--from-picture", tool_path("t.png"), "--picture-size", "160mm", "--drawing",
                                tool_path("drawing.svg"));
    assert_int_equal(p.exit_code, 0);
    char *svg = read_file(tool_path("drawing.svg"));
    assert_non_null(strstr(svg, "<svg xmlns"));
    assert_non_null(strstr(svg, "11 mm apart, across 45.0&#176;"));
    assert_non_null(strstr(svg, "</svg>"));
    free(svg);
}

/* The whole, averaged, is fewer samples high than a drawing shows as a rule. */
TEST(a_drawing_of_a_long_low_picture_stays_inside_it) {
    enum { WIDTH = 8192, HEIGHT = 64 };
    unsigned char *flat = calloc((size_t)3 * WIDTH, HEIGHT);
    assert_non_null(flat);
    write_png("low.png", flat, WIDTH, HEIGHT, NULL);
    free(flat);
    SCOPED_PROCESS p = RUN_TOOL("tag", "--from-picture", tool_path("low.png"), "--picture-size", "1m", "--drawing",
                                tool_path("low.svg"));
    assert_int_equal(p.exit_code, 3);
    char *svg = read_file(tool_path("low.svg"));
    assert_non_null(strstr(svg, "no regular pattern"));
    free(svg);
}

/* --- refused --- */

static void write_bad_pictures(void) {
    static const unsigned char huge[] =
        "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x4e\x20\0\0\x4e\x20\x08\2\0\0\0\x6c\x12\xd1\x6e\0\0\0\x08IDAT";
    static const unsigned char ktx2[64] = "\xabKTX 20\xbb\r\n\x1a\n";
    static unsigned char flat[SIDE * SIDE * 3];
    const drawn_axis a = {11.0, 45.0, DRAWN_SINE};
    uint64_t seed = 1;
    for (size_t i = 0; i < sizeof flat; i++) {
        flat[i] = (unsigned char)(128.0 + 20.0 * fmax(-5.0, fmin(5.0, drawn_normal(&seed))));
    }
    write_file(tool_path("huge.png"), huge, sizeof huge - 1);
    write_file(tool_path("basis.ktx2"), ktx2, sizeof ktx2);
    write_file(tool_path("empty.png"), "", 0);
    write_png("noise.png", flat, SIDE, SIDE, NULL);
    write_png("small.png", flat, 40, SIDE, NULL);
    write_png("t.png", draw_grey(&a), SIDE, SIDE, NULL);
    write_jpeg("t.jpg", draw_grey(&a));
    struct stat file;
    for (int i = 0; i < 2; i++) {
        char *data = read_file(tool_path(i ? "t.jpg" : "t.png"));
        assert_int_equal(stat(tool_path(i ? "t.jpg" : "t.png"), &file), 0);
        write_file(tool_path(i ? "half.jpg" : "half.png"), data, (size_t)file.st_size / 2);
        free(data);
    }
}

TEST(a_bad_picture_is_named_with_its_fault) {
    static const struct {
        const char *name;
        int code;
        const char *words;
    } table[] = {{"none.png", 1, "none.png: cannot be read"},
                 {"empty.png", 1, "expected a PNG or JPEG picture, found an empty file"},
                 {"huge.png", 1, "expected at most 8192 x 8192 pixels, found 20000 x 20000"},
                 {"basis.ktx2", 1, "expected a PNG or JPEG picture, found KTX2: convert it first"},
                 {"half.png", 1, "damaged PNG: "},
                 {"half.jpg", 1, "damaged JPEG: Premature end"},
                 {"small.png", 1, "expected at least 64 x 64 pixels, found 40 x 160"},
                 {"noise.png", 3, "no regular pattern: this is no grating (confidence 0"}};
    write_bad_pictures();
    for (size_t i = 0; i < COUNT_OF(table); i++) {
        SCOPED_PROCESS p = RUN_TOOL("tag", "--from-picture", tool_path(table[i].name), "--picture-size", "40mm");
        assert_int_equal(p.exit_code, table[i].code);
        if (!strstr(p.err, table[i].words)) {
            fail_msg("%s: expected '%s' in '%s'", table[i].name, table[i].words, p.err);
        }
    }
}

/* A material and the rest of the file, and the words of the refusal. */
TEST(a_material_whose_texture_cannot_be_used_is_refused) {
    static const struct {
        const char *material, *more;
        int scales, code;
        const char *words;
    } table[] = {
        {"", "", 0, 1, "expected a normal, occlusion or base colour texture|--from-picture"},
        {COLOUR, ",\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"gone.png\"}]", 0, 1, "gone.png"},
        {COLOUR, ",\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"../CTestTestfile.cmake\"}]", 0, 1,
         "folder or below"},
        {COLOUR, ",\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"half.png\"}]", 0, 1, "half.png: damaged PNG"},
        {COLOUR,
         ",\"textures\":[{\"extensions\":{\"KHR_texture_basisu\":{\"source\":0}}}],\"images\":"
         "[{\"uri\":\"basis.ktx2\"}]",
         0, 1, "found KTX2"},
        {COLOUR, ",\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"noise.png\"}]", 0, 3, "no regular pattern"},
        {COLOUR, ONE_TEXTURE, 1, 1, "60 mm wide on one surface and 120 mm on|--mesh or --node"},
        {"\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0,\"texCoord\":1}}", ONE_TEXTURE, 0, 1,
         "second set of UVs"},
        {COLOUR, ",\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"t\xff.png\"}]", 0, 1, "JSON"},
    };
    write_bad_pictures();
    for (size_t i = 0; i < COUNT_OF(table); i++) {
        const char *file = write_textured("bad.gltf", table[i].material, table[i].more, table[i].scales);
        SCOPED_PROCESS p = RUN_TOOL("tag", file, "--material", "0", "--from-texture", "--preset", "zip", "--out",
                                    tool_path("out.gltf"));
        assert_int_equal(p.exit_code, table[i].code);
        char words[256];
        (void)snprintf(words, sizeof words, "%s", table[i].words);
        for (const char *word = strtok(words, "|"); word; word = strtok(NULL, "|")) {
            if (!strstr(p.err, word)) {
                fail_msg("%zu: expected '%s' in '%s'", i, word, p.err);
            }
        }
        assert_false(file_exists(tool_path("out.gltf")));
    }
}

TEST(a_node_of_another_scale_is_tagged_by_itself) {
    const drawn_axis a = {20.0, 0.0, DRAWN_SINE};
    write_png("t.png", draw_grey(&a), SIDE, SIDE, NULL);
    SCOPED_PROCESS p =
        RUN_TOOL("tag", write_textured("two.gltf", COLOUR, ONE_TEXTURE, 1), "--node", "large", "--from-texture");
    assert_int_equal(p.exit_code, 0);
    check_number(p.out, "apart", 20.0 * 2.0 * metres[0] / SIDE, 0.02e-3);
}

TEST(a_mesh_without_uvs_has_no_place_for_a_texture) {
    write_bad_pictures();
    const char *file = write_plate("bare.gltf", "{}");
    process p = RUN_TOOL("tag", file, "--from-texture");
    check_refused(&p, 1, "has no UVs that place a picture on it|--ridges", "no UVs");
    SCOPED_PROCESS q =
        RUN_TOOL("tag", file, "--from-picture", tool_path("t.png"), "--picture-size", "10mm", "--axis", "1,0,0");
    assert_int_equal(q.exit_code, 2);
}

TEST(a_drawing_that_cannot_be_written_leaves_nothing) {
    write_bad_pictures();
    process p = RUN_TOOL("tag", "--from-picture", tool_path("t.png"), "--picture-size", "160mm", "--drawing",
                         tool_path("none/drawing.svg"));
    check_refused(&p, 1, "none/drawing.svg", "no folder");
    process q = RUN_TOOL("tag", "--from-picture", tool_path("t.png"), "--picture-size", "160mm", "--drawing",
                         tool_path("t.png"));
    check_refused(&q, 1, "expected an output of its own", "over its input");
    assert_int_equal(files_that_end(".part"), 0);
}

SUITE_FIXTURES(make_folder, remove_folder)
