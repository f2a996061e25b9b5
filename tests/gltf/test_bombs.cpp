// The cost of a file of a megabyte: the tool's time and memory, and the name of the reached limit.
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "gltf/bombs.hpp" // after the streams: cmocka has a macro fail

using namespace builder;

namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__OPTIMIZE__)
constexpr bool is_measured = false; // their memory and time are not ours
#else
constexpr bool is_measured = true;
#endif

struct Cost {
    int status = 0;
    double seconds = 0.0; ///< of CPU: this machine may be busy
    double mebibytes = 0.0;
    std::string message;
};

/// `knurl inspect`, or the tool in KNURL_BOMB_TOOL.
Cost inspect(const std::string &path) {
    const char *other = std::getenv("KNURL_BOMB_TOOL");
    const std::string said = path + ".err";
    const pid_t child = fork();
    if (child == 0) {
        const struct rlimit seconds = {240, 240};
        const struct rlimit room = {rlim_t{10} << 30U, rlim_t{10} << 30U};
        (void)setrlimit(RLIMIT_CPU, &seconds);
        if (is_measured)
            (void)setrlimit(RLIMIT_AS, &room);
        const bool reopened = std::freopen("/dev/null", "w", stdout) && std::freopen(said.c_str(), "w", stderr);
        if (reopened) // NOLINTNEXTLINE(clang-analyzer-optin.taint.GenericTaint): named by the user who runs the test
            execl(other ? other : KNURL_TEST_TOOL, "knurl", "inspect", path.c_str(), static_cast<char *>(nullptr));
        _exit(127);
    }
    assert_true(child > 0);
    Cost cost;
    struct rusage used{};
    assert_int_equal(wait4(child, &cost.status, 0, &used), child);
    const auto seconds = [](const struct timeval &t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    cost.seconds = seconds(used.ru_utime) + seconds(used.ru_stime);
    cost.mebibytes = static_cast<double>(used.ru_maxrss) / 1024.0;
    std::ifstream file(said);
    std::getline(file, cost.message);
    std::remove(said.c_str());
    return cost;
}

TEST(a_megabyte_costs_less_than_a_second_and_256_mebibytes) {
    const std::string path = std::string(KNURL_TEST_TMP) + "/bomb" + std::to_string(getpid()) + ".glb";
    int failed = 0;
    for (const Bomb &bomb : bombs()) {
        std::ofstream(path, std::ios::binary) << bomb.bytes;
        const Cost cost = inspect(path);
        const bool ended = WIFEXITED(cost.status) && WEXITSTATUS(cost.status) <= 1;
        const bool too_much = is_measured && (cost.seconds > 1.0 || cost.mebibytes > 256.0);
        failed += !ended || too_much;
        std::printf("%s| %s | %zu KB | %.2f s | %.0f MiB | %s |\n", !ended || too_much ? "TOO MUCH: " : "", bomb.name,
                    bomb.bytes.size() / 1000, cost.seconds, cost.mebibytes,
                    !ended                 ? "ended by a limit"
                    : cost.message.empty() ? "loads"
                                           : cost.message.substr(0, 300).c_str());
        std::fflush(stdout);
    }
    std::remove(path.c_str());
    assert_int_equal(failed, 0);
}

} // namespace
