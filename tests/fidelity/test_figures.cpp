// The figures' numbers as golden JSON. The values themselves are proven by the other fidelity tests, from closed forms;
// these files detect unintended changes of a figure. Made by `knurl study NAME --out DIR`; an intended change replaces
// the file, and its commit gives the reason. SPDX-License-Identifier: MIT cmocka's macros (fail) break the standard
// headers: they come first
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <string>

#include "support/suite.h"

extern "C" {
#include "study.h"
}

namespace {

using Json = nlohmann::json;

/// Sums of sines and square roots differ by some ulp between C libraries and compilers, and single-precision FFTs
/// (spurious shares) by 1e-6; a figure shows three digits.
constexpr double relative = 1e-5;
constexpr double absolute = 1e-7;

Json load(const std::string &path) {
    std::ifstream file(path);
    if (!file)
        fail_msg("%s: cannot be read", path.c_str());
    return Json::parse(file);
}

void compare(const Json &golden, const Json &found, const std::string &where) {
    if (golden.is_number() && found.is_number()) {
        const double a = golden.get<double>();
        const double b = found.get<double>();
        if (!(std::fabs(a - b) <= absolute + relative * std::fabs(a)))
            fail_msg("%s: expected %.9g, found %.9g", where.c_str(), a, b);
        return;
    }
    if (golden.type() != found.type() || golden.size() != found.size())
        fail_msg("%s: expected the shape of the golden file", where.c_str());
    if (!golden.is_structured()) {
        if (golden != found)
            fail_msg("%s: expected %s, found %s", where.c_str(), golden.dump().c_str(), found.dump().c_str());
        return;
    }
    for (const auto &[key, value] : golden.items()) {
        std::string inner = where;
        inner.append("/").append(key);
        if (golden.is_object() && !found.contains(key))
            fail_msg("%s: missing", inner.c_str());
        compare(value, golden.is_object() ? found.at(key) : found.at(std::stoul(key)), inner);
    }
}

void check(const char *name, int (*run)(const char *folder)) {
    const std::string folder = std::string(KNURL_TEST_TMP) + "/figures";
    assert_int_equal(run(folder.c_str()), 0);
    compare(load(std::string(KNURL_TEST_GOLDEN) + "/" + name + ".json"), load(folder + "/" + name + ".json"), name);
}

TEST(figure_2_signals) {
    check("signals", study_signals);
}

TEST(figure_3_coverage) {
    check("coverage", study_coverage);
}

TEST(figure_4_temporal) {
    check("temporal", study_temporal);
}

TEST(figure_8_preferences) {
    check("preferences", study_preferences);
}

} // namespace
