/* `knurl run --stroke sweep` over every mesh of the demo's assets, the usual primitives and the moon: the distance in
 * contact, and the number of half cycles. Expected values come from the rows of the CSV and the shapes' formulas: 2 fs
 * times the metres along x. SPDX-License-Identifier: MIT */
#include "contact/moon.h"
#include "support/tool.h"

static const char plate[] = KNURL_TEST_ASSETS "/plate_1d.glb";

#define FS       700.0 /* cycles/m */
#define SEGMENTS 96

#define TAG "{\"knurl\":{\"version\":1,\"spatial_frequency\":[700,0],\"amplitude\":0.0002,\"stiffness\":400%s}}"

/* A point's coordinate on a grating, m along its x; null: the path is along x. */
typedef double (*coordinate)(const double p[3], const void *of);

/* --- shapes: surfaces of revolution, u around the axis, v along the profile --- */

typedef struct turned {
    double profile[64][2]; /* radius and height, from below upwards outside */
    uint32_t count;
    int lying;         /* 1: its axis is x; 0: y */
    int inwards;       /* 1: its faces point at the axis */
    uint32_t segments; /* round the axis; 0: SEGMENTS */
    double around;     /* m of x in a turn: the area-weighted mean of the circumference */
} turned;

static void add_point(turned *t, double radius, double height) {
    t->profile[t->count][0] = radius;
    t->profile[t->count++][1] = height;
}

/* From one angle to another, counted from the horizontal. */
static void add_arc(turned *t, double centre_radius, double centre_height, double radius, double from, double to) {
    for (int i = 0; i <= 24; i++) {
        const double a = from + (to - from) * i / 24.0;
        add_point(t, fmax(0.0, centre_radius + radius * cos(a)), centre_height + radius * sin(a));
    }
}

static double angle_round(const double p[3], const void *of) {
    const turned *t = of;
    const double angle = t->lying ? atan2(-p[1], p[2]) : atan2(p[0], p[2]);
    return t->around * angle / (2.0 * PI);
}

static shape turn(turned *t) {
    const uint32_t segments = t->segments > 0 ? t->segments : SEGMENTS;
    const uint32_t columns = segments + 1;
    shape s = shape_new(columns * t->count, 6 * segments * (t->count - 1), 1);
    double area = 0.0;
    double sum = 0.0;
    uint32_t at = 0;
    for (uint32_t i = 0; i < t->count; i++) {
        const double r = t->profile[i][0];
        const double h = t->profile[i][1];
        for (uint32_t j = 0; j < columns; j++) {
            const double a = 2.0 * PI * j / segments;
            const uint32_t v = i * columns + j;
            shape_set(&s, v, t->lying ? h : r * sin(a), t->lying ? -r * sin(a) : h, r * cos(a));
            s.uvs[2 * v] = (float)((double)j / segments);
            s.uvs[2 * v + 1] = (float)((double)i / (t->count - 1));
            if (i + 1 < t->count && j + 1 < columns) {
                const uint32_t up = v + columns;
                at = t->inwards ? shape_quad(&s, at, v, up, up + 1, v + 1) : shape_quad(&s, at, v, v + 1, up + 1, up);
            }
        }
        if (i + 1 < t->count) { /* a band: two triangles a quad, over which dP/du is their edge along u */
            const double *next = t->profile[i + 1];
            const double slant = hypot(next[0] - r, next[1] - h);
            area += slant * (r + next[0]);
            sum += slant * 2.0 * PI * (r * r + next[0] * next[0]);
        }
    }
    t->around = sum / area;
    return s;
}

/* A sheet bent over an arc of 2 rad, u along the arc. */
#define SHEET_RADIUS 0.04

static double angle_of_sheet(const double p[3], const void *of) {
    (void)of;
    return SHEET_RADIUS * atan2(p[0], p[1] + SHEET_RADIUS);
}

static shape bent_sheet(void) {
    const uint32_t columns = 49;
    shape s = shape_new(2 * columns, 6 * (columns - 1), 1);
    uint32_t at = 0;
    for (uint32_t j = 0; j < columns; j++) {
        const double a = -1.0 + 2.0 * j / (columns - 1);
        for (uint32_t i = 0; i < 2; i++) {
            const uint32_t v = 2 * j + i;
            shape_set(&s, v, SHEET_RADIUS * sin(a), SHEET_RADIUS * (cos(a) - 1.0), i == 0 ? 0.02 : -0.02);
            s.uvs[2 * v] = (float)(0.5 + 0.5 * a);
            s.uvs[2 * v + 1] = (float)i;
        }
        if (j + 1 < columns) {
            at = shape_quad(&s, at, 2 * j, 2 * j + 2, 2 * j + 3, 2 * j + 1);
        }
    }
    return s;
}

static double along_x(const double p[3], const void *of) {
    (void)of;
    return p[0];
}

/* --- files --- */

static const char *write_shape(const shape *s, const char *more) {
    const size_t sizes[3] = {12 * (size_t)s->vertex_count, s->uvs ? 8 * (size_t)s->vertex_count : 0,
                             4 * (size_t)s->index_count};
    const size_t all = sizes[0] + sizes[1] + sizes[2];
    char *bytes = malloc(all);
    char tag[256];
    char text[2048];
    char uv[256] = "";
    char uv_view[128] = "";
    float low[3] = {1e9F, 1e9F, 1e9F};
    float high[3] = {-1e9F, -1e9F, -1e9F};
    assert_non_null(bytes);
    memcpy(bytes, s->positions, sizes[0]);
    if (s->uvs) {
        memcpy(bytes + sizes[0], s->uvs, sizes[1]);
    }
    memcpy(bytes + sizes[0] + sizes[1], s->indices, sizes[2]);
    write_file(tool_path("shape.bin"), bytes, all);
    free(bytes);
    for (uint32_t i = 0; i < 3 * s->vertex_count; i++) {
        low[i % 3] = fminf(low[i % 3], s->positions[i]);
        high[i % 3] = fmaxf(high[i % 3], s->positions[i]);
    }
    (void)snprintf(tag, sizeof tag, TAG, more);
    if (s->uvs) {
        (void)snprintf(uv, sizeof uv, ",{\"bufferView\":2,\"componentType\":5126,\"count\":%u,\"type\":\"VEC2\"}",
                       (unsigned)s->vertex_count);
        (void)snprintf(uv_view, sizeof uv_view, ",{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}", sizes[0],
                       sizes[1]);
    }
    (void)snprintf(text, sizeof text,
                   "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
                   "\"nodes\":[{\"name\":\"shape\",\"mesh\":0}],\"materials\":[{\"extras\":%s}],"
                   "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0%s},\"indices\":1,\"material\":0}]}],"
                   "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":%u,\"type\":\"VEC3\","
                   "\"min\":[%.9g,%.9g,%.9g],\"max\":[%.9g,%.9g,%.9g]},"
                   "{\"bufferView\":1,\"componentType\":5125,\"count\":%u,\"type\":\"SCALAR\"}%s],"
                   "\"bufferViews\":[{\"buffer\":0,\"byteLength\":%zu},{\"buffer\":0,\"byteOffset\":%zu,"
                   "\"byteLength\":%zu}%s],\"buffers\":[{\"uri\":\"shape.bin\",\"byteLength\":%zu}]}",
                   tag, s->uvs ? ",\"TEXCOORD_0\":2" : "", (unsigned)s->vertex_count, (double)low[0], (double)low[1],
                   (double)low[2], (double)high[0], (double)high[1], (double)high[2], (unsigned)s->index_count, uv,
                   sizes[0], sizes[0] + sizes[1], sizes[2], uv_view, all);
    write_text(tool_path("shape.gltf"), text);
    return tool_path("shape.gltf");
}

/* --- runs --- */

/* A hand's motion, from its positions in the CSV. */
typedef struct way {
    double metres;  /* in contact, by chords of 20 ms, so that an encoder's steps do not add to it */
    double along_x; /* m of the grating's coordinate */
} way;

static way read_way(const char *path, coordinate where, const void *of, double turn_length) {
    way w = {0.0, 0.0};
    char *csv = read_file(path);
    double before[3] = {0.0, 0.0, 0.0};
    int touched = 0;
    size_t row = 0;
    for (const char *line = strchr(csv, '\n') + 1; *line; line = strchr(line, '\n') + 1, row++) {
        double p[3];
        if (row % 20 != 0) {
            continue;
        }
        const char *at = line;
        for (int axis = 0; axis < 3; axis++) { /* after t */
            char *end;
            at = strchr(at, ',') + 1;
            p[axis] = strtod(at, &end);
            assert_true(end > at && *end == ',');
        }
        const size_t length = strcspn(line, "\n");
        const char *none = strstr(line, ",none,");
        const int touches = !none || none > line + length;
        if (touched && touches) {
            const double chord =
                sqrt((p[0] - before[0]) * (p[0] - before[0]) + (p[1] - before[1]) * (p[1] - before[1]) +
                     (p[2] - before[2]) * (p[2] - before[2]));
            const double x = where ? fabs(where(p, of) - where(before, of)) : chord;
            w.metres += chord;
            w.along_x += turn_length > 0.0 && x > 0.5 * turn_length ? turn_length - x : x;
        }
        memcpy(before, p, sizeof before);
        touched = touches;
    }
    free(csv);
    return w;
}

/* A sweep of 5 s. */
static void check_sweep(const char *name, const char *file, const char *surface, double fs, coordinate where,
                        const void *of, double turn_length) {
    SCOPED_PROCESS p = RUN_TOOL("run", file, "--fast", "--stroke", "sweep", "--out", tool_path("swept.csv"),
                                surface ? "--surface" : NULL, surface);
    if (p.exit_code != 0) {
        print_error("%s: exit %d: %s", name, p.exit_code, p.err);
    }
    assert_int_equal(p.exit_code, 0);
    const way w = read_way(tool_path("swept.csv"), where, of, turn_length);
    const double expected = 2.0 * fs * w.along_x;
    const double crossed = json_number_of(p.out, "half_cycles_crossed");
    const double played = json_number_of(p.out, "half_cycles_played");
    print_message("%-22s %6.3f m moved, %6.3f told  %5.0f half cycles expected, %5.0f crossed, %5.0f played\n", name,
                  w.metres, json_number_of(p.out, "metres"), expected, crossed, played);
    assert_true(w.metres > 0.1);
    assert_true(expected > 100.0);
    CHECK_CLOSE(json_number_of(p.out, "metres"), w.metres, 0.1 * w.metres);
    CHECK_CLOSE(crossed, expected, 0.06 * expected);
    CHECK_CLOSE(played, expected, 0.08 * expected);
}

static void check_turned(const char *name, turned *t) {
    SCOPED_SHAPE s = turn(t);
    check_sweep(name, write_shape(&s, ""), NULL, FS, angle_round, t, t->around);
}

TEST(every_mesh_of_the_demos_assets_is_felt) {
    static const char *const bars[] = {"bar 1 mm", "bar 0.5 mm", "bar 2 mm"};
    static const double frequencies[] = {1000.0, 2000.0, 500.0};
    for (size_t i = 0; i < COUNT_OF(bars); i++) {
        check_sweep(bars[i], plate, bars[i], frequencies[i], along_x, NULL, 0.0);
    }
    check_sweep("grid", KNURL_TEST_ASSETS "/grid_2d.glb", NULL, 1000.0, along_x, NULL, 0.0);
    check_sweep("knurled handle", KNURL_TEST_ASSETS "/knurled_handle.glb", NULL, 800.0, NULL, NULL, 0.0);
}

TEST(a_sphere_is_felt) {
    turned t = {.count = 0};
    add_arc(&t, 0.0, 0.0, 0.03, -0.5 * PI, 0.5 * PI);
    check_turned("sphere", &t);
}

/* The sweep begins on the pole, at a vertex with more triangles than a tick can test. */
TEST(a_sphere_is_felt_however_many_triangles_meet_at_its_pole) {
    static const uint32_t segments[3] = {384, 512, 1024};
    for (size_t i = 0; i < COUNT_OF(segments); i++) {
        turned t = {.count = 0, .segments = segments[i]};
        add_arc(&t, 0.0, 0.0, 0.03, -0.5 * PI, 0.5 * PI);
        check_turned("sphere of many segments", &t);
    }
}

TEST(a_torus_is_felt_lying_and_standing) {
    for (int lying = 0; lying < 2; lying++) {
        turned t = {.count = 0, .lying = lying};
        add_arc(&t, 0.03, 0.0, 0.01, -PI, PI);
        check_turned(lying ? "torus, axis x" : "torus, axis y", &t);
    }
}

TEST(a_cone_is_felt) {
    turned t = {.count = 0};
    add_point(&t, 0.0, -0.03);
    add_point(&t, 0.03, -0.03);
    for (int i = 1; i <= 20; i++) {
        add_point(&t, 0.03 * (1.0 - 0.05 * i), -0.03 + 0.003 * i);
    }
    check_turned("cone", &t);
}

TEST(a_cylinder_is_felt_lying_and_standing) {
    for (int lying = 0; lying < 2; lying++) {
        turned t = {.count = 0, .lying = lying};
        for (int i = 0; i <= 5; i++) {
            add_point(&t, 0.004 * i, -0.03);
        }
        for (int i = 5; i >= 0; i--) {
            add_point(&t, 0.004 * i, 0.03);
        }
        check_turned(lying ? "cylinder, lying" : "cylinder, standing", &t);
    }
}

TEST(a_capsule_is_felt) {
    turned t = {.count = 0, .lying = 1};
    add_arc(&t, 0.0, -0.02, 0.015, -0.5 * PI, 0.0);
    add_arc(&t, 0.0, 0.02, 0.015, 0.0, 0.5 * PI);
    check_turned("capsule", &t);
}

TEST(a_dome_is_felt) {
    turned t = {.count = 0};
    add_arc(&t, 0.0, 0.0, 0.04, 0.0, 0.5 * PI);
    check_turned("dome", &t);
}

/* Its faces point inwards: it is felt from the inside, like a bowl. */
TEST(a_sphere_that_is_inside_out_is_felt_from_inside) {
    turned t = {.count = 0, .inwards = 1};
    add_arc(&t, 0.0, 0.0, 0.03, -0.5 * PI, 0.5 * PI);
    check_turned("sphere, inside out", &t);
}

TEST(a_bent_sheet_is_felt) {
    SCOPED_SHAPE s = bent_sheet();
    check_sweep("bent sheet", write_shape(&s, ""), NULL, FS, angle_of_sheet, NULL, 0.0);
}

/* By an axis: ridges are the intersections of the surface with planes across it. */
TEST(a_sphere_by_an_axis_is_felt) {
    turned t = {.count = 0};
    add_arc(&t, 0.0, 0.0, 0.03, -0.5 * PI, 0.5 * PI);
    SCOPED_SHAPE s = turn(&t);
    check_sweep("sphere, axis x", write_shape(&s, ",\"axis\":[1,0,0]"), NULL, FS, along_x, NULL, 0.0);
}

TEST(the_moon_is_felt) {
    shape s = body_moon();
    if (s.index_count == 0) {
        shape_free(&s);
        print_message("skipped: no moon in " KNURL_TEST_CORPUS "\n");
        skip();
    }
    check_sweep("moon", write_shape(&s, ",\"axis\":[1,0,0]"), NULL, FS, along_x, NULL, 0.0);
    shape_free(&s);
}

/* Round the anchor of a lying cylinder, bent over it: in contact all the time once it has come down. */
TEST(a_circle_stays_on_a_curved_surface) {
    turned t = {.count = 0, .lying = 1};
    add_point(&t, 0.02, -0.04);
    add_point(&t, 0.02, 0.04);
    SCOPED_SHAPE s = turn(&t);
    SCOPED_PROCESS p = RUN_TOOL("run", write_shape(&s, ""), "--fast", "--stroke", "circle", "--seconds", "3");
    assert_int_equal(p.exit_code, 0);
    assert_true(json_number_of(p.out, "contact_s") > 2.75);
    assert_true(json_number_of(p.out, "metres") > 0.2); /* 0.1 m/s, from 0.25 s on */
    assert_true(json_number_of(p.out, "half_cycles_played") > 50.0);
}

/* --- runs that feel nothing --- */

static void check_nothing_felt(process *p, const char *why) {
    assert_int_equal(p->exit_code, 4);
    assert_non_null(strstr(p->err, why));
    assert_non_null(strstr(p->out, "\"half_cycles_played\": 0,")); /* the summary is still printed */
    process_free(p);
}

TEST(a_run_that_never_touches_says_so) {
    write_text(tool_path("air.csv"), "t,x,y,z\n0,0,0.01,0\n2,0.05,0.01,0\n");
    process p = RUN_TOOL("run", plate, "--fast", "--trace", tool_path("air.csv"));
    check_nothing_felt(&p, "knurl: run: nothing was touched in 2 s: ");
}

/* Half a millimetre across: no room for a stroke. */
TEST(a_stroke_that_hardly_moves_says_so) {
    static const double half[2] = {0.00025, 0.00025};
    SCOPED_SHAPE s = shape_sheet(1, 1, half, NULL);
    process p = RUN_TOOL("run", write_shape(&s, ""), "--fast", "--stroke", "sweep");
    check_nothing_felt(&p, "knurl: run: the stroke over 'shape' is ");
}

TEST(a_press_and_a_short_run_need_not_move) {
    process p = RUN_TOOL("run", plate, "--fast", "--stroke", "press", "--seconds", "2");
    assert_int_equal(p.exit_code, 0);
    process_free(&p);
    p = RUN_TOOL("run", plate, "--fast", "--seconds", "0.1");
    assert_int_equal(p.exit_code, 0);
    process_free(&p);
}

SUITE_FIXTURES(make_folder, remove_folder)
