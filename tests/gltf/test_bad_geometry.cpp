// Scenes of bad geometry, each as a glTF file and as mesh descriptions: every press is held by a finite force that its
// depth bounds, or the load reports the fault. One row of `scenes` per scene. SPDX-License-Identifier: MIT
#include "builder.hpp"
#include "support/close.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace {

constexpr double K = 400.0;        // N/m
constexpr double STEP = 100e-6;    // m a tick
constexpr double TOLERANCE = 2e-6; // m: corners as floats, seams
constexpr double SIZE = 0.02;      // m: half of a sheet
constexpr int CELLS = 16;          // of an uneven sheet, along each side

using Point = std::array<double, 3>;

// A mesh as a list of triangles; no vertex is shared.
struct Part {
    std::vector<float> corners;
    bool double_sided = false;

    size_t count() const {
        return corners.size() / 9;
    }
    Part &triangle(const Point &a, const Point &b, const Point &c) {
        for (const Point *p : {&a, &b, &c})
            for (const double x : *p)
                corners.push_back(static_cast<float>(x));
        return *this;
    }
    Part &quad(const Point &a, const Point &b, const Point &c, const Point &d) {
        return triangle(a, b, c).triangle(a, c, d);
    }
    // A parallelogram from `at`, in strips along u; its front is towards u x v.
    Part &strips(const Point &at, const Point &u, const Point &v, int count) {
        const auto point = [&](int i, double j) {
            Point p = at;
            for (size_t k = 0; k < 3; ++k)
                p[k] += u[k] * i / count + v[k] * j;
            return p;
        };
        for (int i = 0; i < count; ++i)
            quad(point(i, 0), point(i + 1, 0), point(i + 1, 1), point(i, 1));
        return *this;
    }
    // Each `every`-th triangle is reversed.
    Part &turn_over(size_t first, size_t every) {
        for (size_t i = first; i < count(); i += every)
            for (size_t k = 0; k < 3; ++k)
                std::swap(corners[9 * i + 3 + k], corners[9 * i + 6 + k]);
        return *this;
    }
    // T-junctions: each `every`-th triangle's first edge gets a vertex in its middle that its neighbour does not have.
    Part &split_edges(size_t first, size_t every, double off) {
        for (size_t i = first, last = count(); i < last; i += every) {
            Point p[3], middle{0, 0, off};
            for (size_t k = 0; k < 9; ++k)
                p[k / 3][k % 3] = static_cast<double>(corners[9 * i + k]);
            for (size_t k = 0; k < 3; ++k) {
                middle[k] += (p[0][k] + p[1][k]) / 2;
                corners[9 * i + 3 + k] = static_cast<float>(middle[k]);
            }
            triangle(middle, p[1], p[2]);
        }
        return *this;
    }
    Part &append(const Part &other) {
        const std::vector<float> more = other.corners;
        corners.insert(corners.end(), more.begin(), more.end());
        return *this;
    }
    Part &from_both_sides() {
        double_sided = true;
        return *this;
    }
};
using Parts = std::vector<Part>;

// Looking up, each vertex up to `uneven` m off z = 0.
Part sheet(double uneven, int cells = CELLS) {
    uint64_t seed = 7;
    std::vector<Point> points;
    for (int i = 0; i <= cells; ++i)
        for (int j = 0; j <= cells; ++j)
            points.push_back({SIZE * (2.0 * i / cells - 1.0), SIZE * (2.0 * j / cells - 1.0),
                              random_between(&seed, -uneven, uneven)});
    Part part;
    for (size_t i = 0, row = static_cast<size_t>(cells) + 1; i + row + 1 < points.size(); ++i)
        if (i % row + 1 < row)
            part.quad(points[i], points[i + row], points[i + row + 1], points[i + 1]);
    return part;
}

Part floor_in_strips(int count) { // z = 0 where x > 0
    return Part().strips({0, SIZE, 0}, {0, -2 * SIZE, 0}, {SIZE, 0, 0}, count);
}

Part wall_in_strips(int count, double from = 0.0) { // x = 0, z > from
    return Part().strips({0, -SIZE, from}, {0, 2 * SIZE, 0}, {0, 0, SIZE - from}, count);
}

Part groove() { // 45 degrees; its bottom edge is one on the one side, two on the other
    return Part()
        .strips({-SIZE, -SIZE, SIZE}, {SIZE, 0, -SIZE}, {0, 2 * SIZE, 0}, 1)
        .strips({0, SIZE, 0}, {0, -2 * SIZE, 0}, {SIZE, 0, SIZE}, 2);
}

Part box(const Point &low, const Point &high) {
    const double x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
    return Part()
        .strips(low, {0, y, 0}, {x, 0, 0}, 1)
        .strips({low[0], low[1], high[2]}, {x, 0, 0}, {0, y, 0}, 1)
        .strips(low, {x, 0, 0}, {0, 0, z}, 1)
        .strips({low[0], high[1], low[2]}, {0, 0, z}, {x, 0, 0}, 1)
        .strips(low, {0, 0, z}, {0, y, 0}, 1)
        .strips({high[0], low[1], low[2]}, {0, y, 0}, {0, 0, z}, 1);
}

Part left_box() {
    return box({-0.01, -0.01, -0.01}, {0.001, 0.01, 0.0});
}
Part right_box() {
    return box({-0.001, -0.01, -0.011}, {0.01, 0.01, 0.0});
}
Part speck() {
    return Part().triangle({1e-3, 1e-3, 0}, {1e-3, 1e-3 + 1e-33, 0}, {1e-3, 1e-3, 1e-33});
}

// --- minimum depth of a HIP: m inside of the true shape ---

double below(const Point &p) {
    return -p[2];
}
double below_20um(const Point &p) {
    return -p[2] - 20e-6;
}
double below_1mm(const Point &p) { // no point of the sheet is lower, so the HIP's contact is at least as far away
    return -p[2] - 1e-3;
}
double in_corner(const Point &p) { // outside is x > 0 and z > 0
    return std::max(-p[0], -p[2]);
}
double in_groove(const Point &p) {
    return (std::fabs(p[0]) - p[2]) * std::sqrt(0.5);
}

// Strokes start and end at the empty top of this box, and move in all of it.
struct Box {
    Point low, high;
};
constexpr Box plate{{-0.004, -0.004, -0.0015}, {0.004, 0.004, 0.0015}};
constexpr Box rough{{-0.004, -0.004, -0.003}, {0.004, 0.004, 0.0025}};
constexpr Box corner{{-0.002, -0.004, -0.002}, {0.003, 0.004, 0.003}};

struct Scene {
    const char *name;
    Parts (*make)();
    double (*depth)(const Point &);
    const Box *where;
    uint32_t turned = 0;        // triangles of the first part
    const char *word = nullptr; // in the message if it is refused
};

constexpr Scene scenes[] = {
    {"floor and wall, two meshes", [] { return Parts{floor_in_strips(1), wall_in_strips(1)}; }, in_corner, &corner},
    {"floor and wall, their edges split", [] { return Parts{floor_in_strips(3), wall_in_strips(2)}; }, in_corner,
     &corner},
    {"T-junction of floor and wall", [] { return Parts{floor_in_strips(1).append(wall_in_strips(2))}; }, in_corner,
     &corner},
    {"groove, bottom edge split", [] { return Parts{groove()}; }, in_groove, &corner},
    {"T-junction, 20 um", [] { return Parts{sheet(20e-6).split_edges(272, 512, 0.0)}; }, below_20um, &plate},
    {"T-junctions off by 5 um", [] { return Parts{sheet(20e-6).split_edges(0, 7, 5e-6)}; }, below_20um, &plate},
    {"T-junction, 1 mm", [] { return Parts{sheet(1e-3).split_edges(272, 512, 0.0)}; }, below_1mm, &rough},
    {"sliver", [] { return Parts{sheet(20e-6).triangle({-0.02, 0, 0}, {0.02, 1e-7, 0}, {0.02, 3e-7, 1e-6})}; },
     below_20um, &plate},
    {"plate and a triangle of 1e-33 m", [] { return Parts{sheet(0.0, 2).append(speck())}; }, below, &plate},
    {"a triangle of 1e-33 m", [] { return Parts{speck()}; }, below, &plate, 0, "expected a triangle with an area"},
    {"faces twice", [] { return Parts{sheet(20e-6).append(sheet(20e-6))}; }, below_20um, &plate},
    {"faces and their reverse", [] { return Parts{sheet(20e-6).append(sheet(20e-6).turn_over(0, 1))}; }, below_20um,
     &plate},
    {"all reversed", [] { return Parts{sheet(20e-6).turn_over(0, 1).from_both_sides()}; }, below_20um, &plate},
    {"one face reversed", [] { return Parts{sheet(20e-6).turn_over(272, 512)}; }, below_20um, &plate, 1},
    {"each third reversed", [] { return Parts{sheet(20e-6).turn_over(0, 3)}; }, below_20um, &plate, 171},
    {"each third reversed, flat", [] { return Parts{sheet(0.0).turn_over(0, 3)}; }, below, &plate, 171},
    {"each second reversed", [] { return Parts{sheet(0.0).turn_over(0, 2)}; }, below, &plate, 256},
    {"each third reversed, both sides", [] { return Parts{sheet(20e-6).turn_over(0, 3).from_both_sides()}; },
     below_20um, &plate, 171},
    {"boxes, a face reversed each", [] { return Parts{left_box().turn_over(2, 99), right_box().turn_over(3, 99)}; },
     below, &plate, 1},
    {"a face reversed, a T-junction", [] { return Parts{sheet(20e-6).turn_over(238, 512).split_edges(272, 512, 0.0)}; },
     below_20um, &plate, 1},
    {"a face reversed at a T-junction",
     [] { return Parts{sheet(20e-6).turn_over(272, 512).split_edges(272, 512, 0.0)}; }, below_20um, &plate, 2},
    {"each third reversed, T-junctions off by 5 um",
     [] { return Parts{sheet(20e-6).turn_over(0, 3).split_edges(0, 7, 5e-6)}; }, below_20um, &plate, 171 + 25},
    {"boxes that intersect, one mesh, a face reversed each",
     [] { return Parts{left_box().turn_over(2, 99).append(right_box().turn_over(3, 99))}; }, below, &plate, 2},
    {"a mesh twice", [] { return Parts{sheet(20e-6), sheet(20e-6)}; }, below_20um, &plate},
    {"a plane five times", [] { return Parts(5, sheet(0.0, 1)); }, below, &plate},
    {"a mesh and its reverse", [] { return Parts{sheet(20e-6), sheet(20e-6).turn_over(0, 1)}; }, below_20um, &plate},
    {"a plane and its reverse", [] { return Parts{sheet(0.0, 1), sheet(0.0, 1).turn_over(0, 1)}; }, below, &plate},
    {"boxes that intersect", [] { return Parts{left_box(), right_box()}; }, below, &plate},
    {"boxes that intersect, one mesh", [] { return Parts{left_box().append(right_box())}; }, below, &plate},
    {"wall through a floor", [] { return Parts{sheet(0.0, 2), wall_in_strips(1, -SIZE)}; }, in_corner, &corner},
    {"wall through a floor, one mesh", [] { return Parts{sheet(0.0, 2).append(wall_in_strips(1, -SIZE))}; }, in_corner,
     &corner},
};

// --- the two ways in ---

#define TAG R"("extras":{"knurl":{"version":1,"spatial_frequency":0,"amplitude":0,"stiffness":400,"axis":[0,1,0]}}})"

std::string file_of(const Parts &parts) {
    builder::File file;
    file.nodes = "";
    file.materials = "{" TAG ",{\"doubleSided\":true," TAG;
    for (const Part &part : parts) {
        const std::string mesh = std::to_string(&part - parts.data()),
                          accessor = std::to_string(file.vec3(part.corners));
        builder::File::append(file.nodes, R"({"mesh":)" + mesh + "}");
        builder::File::append(file.meshes, R"({"primitives":[{"material":)" +
                                               std::to_string(part.double_sided ? 1 : 0) +
                                               R"(,"attributes":{"POSITION":)" + accessor + "}}]}");
    }
    return file.glb();
}

knurl_result add_parts(knurl_scene *scene, const Parts &parts) {
    knurl_result result = KNURL_OK;
    for (const Part &part : parts) {
        knurl_surface_desc desc;
        knurl_mesh_desc mesh;
        knurl_material_desc material;
        knurl_surface_id id = 0;
        knurl_surface_desc_init(&desc, sizeof desc);
        knurl_mesh_desc_init(&mesh, sizeof mesh);
        knurl_material_desc_init(&material, sizeof material);
        mesh.positions = part.corners.data();
        mesh.vertex_count = static_cast<uint32_t>(3 * part.count());
        material.stiffness = K;
        desc.mesh = &mesh;
        desc.material = &material;
        desc.axis[1] = 1.0;
        desc.double_sided = part.double_sided ? 1 : 0;
        result = result ? result : knurl_scene_add_surface(scene, &desc, &id);
    }
    return result;
}

// --- strokes ---

// Device axes are the scene's, and no protection changes a force.
void configure(knurl_scene *scene) {
    knurl_workspace workspace;
    knurl_hip_desc hip;
    knurl_workspace_set_identity(&workspace);
    knurl_hip_desc_init(&hip, sizeof hip);
    hip.max_force = 1e6;
    hip.protections = 0;
    hip.workspace = &workspace;
    assert_int_equal(knurl_scene_configure_hip(scene, 0, &hip), KNURL_OK);
}

double distance(const double a[3], const double b[3]) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

knurl_tick_output tick_at(knurl_scene *scene, const Point &p) {
    knurl_tick_input input{};
    knurl_tick_output out;
    std::copy(p.begin(), p.end(), input.position);
    assert_int_equal(knurl_scene_tick(scene, 0, &input, &out), KNURL_OK);
    return out;
}

void check_tick(const Scene &s, const char *way, const Point &at, const knurl_tick_output &out) {
    const double none[3] = {0.0, 0.0, 0.0}, force = distance(out.force, none);
    const double most = K * out.contacts * (distance(out.proxy, at.data()) + TOLERANCE);
    const double depth = s.depth(at) - TOLERANCE, least = depth > 0.0 ? K * depth * (1.0 - 1e-6) : 0.0;
    if (!(force >= least && force <= most + 1e-12))
        fail_msg("%s, %s: at %g %g %g expected %g to %g N, found %g", s.name, way, at[0], at[1], at[2], least, most,
                 force);
}

// In, along four legs, and out.
void stroke(knurl_scene *scene, const Scene &s, const char *way, uint64_t *seed) {
    const Point low = s.where->low, high = s.where->high;
    const Point start{random_between(seed, s.where == &corner ? 0.0005 : low[0], high[0]),
                      random_between(seed, low[1], high[1]), high[2]};
    Point from = start;
    configure(scene);
    (void)tick_at(scene, start);
    for (int leg = 0; leg < 6; ++leg) {
        Point to = start;
        for (size_t k = 0; k < 3 && leg < 5; ++k)
            to[k] = leg == 0 && k == 2 ? low[k] : random_between(seed, low[k], high[k]);
        const int ticks = static_cast<int>(distance(to.data(), from.data()) / STEP) + 1;
        Point at = from;
        for (int i = 1; i <= ticks; ++i) {
            for (size_t k = 0; k < 3; ++k)
                at[k] = from[k] + (to[k] - from[k]) * i / ticks;
            check_tick(s, way, at, tick_at(scene, at));
        }
        from = to;
    }
    assert_int_equal(tick_at(scene, start).contacts, 0);
}

void check_scene(const Scene &s, const char *way, builder::Loaded &loaded, knurl_result result) {
    uint64_t seed = 11;
    if (s.word) {
        assert_int_equal(result, KNURL_ERROR_ARGUMENT);
        assert_non_null(std::strstr(knurl_error_message(), s.word));
        return;
    }
    if (result)
        fail_msg("%s, %s: %s", s.name, way, knurl_error_message());
    assert_int_equal(loaded.info().turned_triangles, s.turned);
    assert_int_equal(knurl_scene_commit(loaded.scene), KNURL_OK);
    for (int i = 0; i < 20; ++i)
        stroke(loaded.scene, s, way, &seed);
}

} // namespace

TEST(bad_geometry_in_files_is_held_or_refused) {
    for (const Scene &s : scenes) {
        builder::Loaded loaded;
        check_scene(s, "file", loaded, loaded.load(file_of(s.make())));
    }
}

TEST(bad_geometry_in_descriptions_is_held_or_refused) {
    for (const Scene &s : scenes) {
        builder::Loaded loaded;
        check_scene(s, "description", loaded, add_parts(loaded.scene, s.make()));
    }
}

knurl_surface_check check_first(const builder::Loaded &loaded) {
    knurl_surface_check check;
    knurl_surface_check_init(&check, sizeof check);
    assert_int_equal(knurl_scene_check_surface(loaded.scene, 0, knurl_scene_get_surface(loaded.scene, 0), &check),
                     KNURL_OK);
    return check;
}

// Turned triangles are warned of; a front that was not found makes the surface double-sided.
TEST(mixed_winding_is_warned_of) {
    for (const size_t every : {512, 3, 2}) {
        builder::Loaded loaded(file_of({sheet(20e-6).turn_over(0, every)}));
        const knurl_surface_check check = check_first(loaded);
        assert_int_equal(check.exceeded, KNURL_LIMIT_WINDING);
        assert_non_null(std::strstr(check.message, every == 512 ? "1 of its 512 triangles" : " of its 512 triangles"));
        assert_int_equal(loaded.info().double_sided, every == 2);
    }
}

// If a mesh touches itself, halves of the same area are not changed. This is a fault unless both sides are felt.
TEST(mixed_winding_that_stays_is_warned_of) {
    Part halves = sheet(20e-6).turn_over(0, 2).split_edges(272, 512, 0.0);
    for (const bool double_sided : {false, true}) {
        halves.double_sided = double_sided;
        builder::Loaded loaded(file_of({halves}));
        const knurl_surface_check check = check_first(loaded);
        assert_int_equal(check.exceeded, double_sided ? 0 : KNURL_LIMIT_WINDING);
        assert_int_equal(std::strstr(check.message, "may let the HIP through") != nullptr, !double_sided);
        assert_int_equal(loaded.info().turned_triangles, 0);
    }
}

// Parts that touch and T-junctions are no mixed winding.
TEST(parts_that_touch_are_not_warned_of) {
    for (const Part &part : {left_box().append(right_box()), groove(), sheet(20e-6).split_edges(0, 7, 5e-6)}) {
        builder::Loaded loaded(file_of({part}));
        assert_int_equal(check_first(loaded).exceeded, 0);
    }
}

// A Moebius strip has one side only: it is held from both sides, along all of it and over the joint of its ends.
TEST(a_strip_with_one_side_is_held_from_both) {
    constexpr int N = 60;
    constexpr double RADIUS = 0.015;
    const double pi = std::acos(-1.0);
    const auto point = [&](double turn, double across, double above) {
        const double a = 2.0 * pi * turn;
        const double c = std::cos(a), s = std::sin(a), hc = std::cos(0.5 * a), hs = std::sin(0.5 * a);
        const double out = RADIUS + across * hc + above * hs; // the normal is hs outwards, -hc upwards
        return Point{out * c, out * s, across * hs - above * hc};
    };
    Part strip;
    for (int i = 0; i < N; ++i) {
        const double from = 1.0 * i / N, to = 1.0 * (i + 1) / N;
        if (i + 1 < N)
            strip.quad(point(from, -0.006, 0), point(from, 0.006, 0), point(to, 0.006, 0), point(to, -0.006, 0));
        else // the ends meet, one turned over
            strip.quad(point(from, -0.006, 0), point(from, 0.006, 0), point(0, -0.006, 0), point(0, 0.006, 0));
    }
    builder::Loaded loaded(file_of({strip}));
    assert_int_equal(loaded.info().double_sided, 1);
    assert_int_equal(knurl_scene_commit(loaded.scene), KNURL_OK);
    for (int side = -1; side <= 1; side += 2) {
        configure(loaded.scene);
        (void)tick_at(loaded.scene, point(0.1, 0.001, 0.002 * side));
        for (int i = 0; i < 2000; ++i) { // twice round: back on the same side
            const Point at = point(0.1 + i * 0.001, 0.001, -0.001 * side);
            const double none[3] = {0.0, 0.0, 0.0}, force = distance(tick_at(loaded.scene, at).force, none);
            assert_true(force > 0.75 * K * 0.001 && force < 1.25 * K * 0.001); // between facets
        }
    }
}
