/* Our declarations of Unity's plugin interface against Unity's own headers: most of it fails to compile if they differ.
 * C++, because some of those headers are. SPDX-License-Identifier: MIT */
#include <cstddef> /* first: Unity's headers use NULL without it */
#include <cstdio>
#include <type_traits>

#include "unity_abi.h"

#include <IUnityInterface.h>
#include <IUnityLog.h>
#include <IUnityProfiler.h>

/* One value is handed over as another: pointers as pointers, numbers and enumerations by their size. */
template <typename OURS, typename THEIRS>
constexpr bool passes_as() {
    return sizeof(OURS) == sizeof(THEIRS) && std::is_pointer_v<OURS> == std::is_pointer_v<THEIRS> &&
           std::is_floating_point_v<OURS> == std::is_floating_point_v<THEIRS>;
}
template <>
constexpr bool passes_as<void, void>() {
    return true;
}

/* One function can be called as another. */
template <typename OURS, typename THEIRS>
struct calls_as : std::false_type {};
template <typename RESULT, typename... OURS, typename OTHER, typename... THEIRS>
struct calls_as<RESULT(UNITY_CALL *)(OURS...), OTHER(UNITY_INTERFACE_API *)(THEIRS...)> {
    static constexpr bool same() {
        if constexpr (sizeof...(OURS) == sizeof...(THEIRS)) {
            return passes_as<RESULT, OTHER>() && (passes_as<OURS, THEIRS>() && ...);
        }
        return false;
    }
    static constexpr bool value = same();
};

#define SAME_PLACE(ours, field, theirs, other)                                                                         \
    static_assert(offsetof(ours, field) == offsetof(theirs, other), #theirs "::" #other " lies elsewhere")
#define SAME_CALL(ours, field, theirs, other)                                                                          \
    SAME_PLACE(ours, field, theirs, other);                                                                            \
    static_assert(calls_as<decltype(ours::field), decltype(theirs::other)>::value, #theirs "::" #other " differs")

static_assert(sizeof(unity_interfaces) == sizeof(IUnityInterfaces), "IUnityInterfaces has another size");
SAME_PLACE(unity_interfaces, get_interface, IUnityInterfaces, GetInterface);
SAME_PLACE(unity_interfaces, register_interface, IUnityInterfaces, RegisterInterface);
SAME_CALL(unity_interfaces, get_interface_split, IUnityInterfaces, GetInterfaceSplit);
SAME_PLACE(unity_interfaces, register_interface_split, IUnityInterfaces, RegisterInterfaceSplit);

static_assert(sizeof(unity_log) == sizeof(IUnityLog), "IUnityLog has another size");
SAME_CALL(unity_log, log, IUnityLog, Log);
static_assert(int(UNITY_LOG_WARNING) == int(kUnityLogTypeWarning), "warnings have another number");

static_assert(sizeof(unity_profiler) <= sizeof(IUnityProfiler), "IUnityProfiler has fewer functions");
SAME_CALL(unity_profiler, emit_event, IUnityProfiler, EmitEvent);
SAME_CALL(unity_profiler, is_enabled, IUnityProfiler, IsEnabled);
SAME_CALL(unity_profiler, is_available, IUnityProfiler, IsAvailable);
SAME_CALL(unity_profiler, create_marker, IUnityProfiler, CreateMarker);
static_assert(int(UNITY_PROFILER_SCRIPTS) == int(kUnityProfilerCategoryScripts), "scripts have another number");
static_assert(int(UNITY_MARKER_DEFAULT) == int(kUnityProfilerMarkerFlagDefault), "no flags have another number");
static_assert(int(UNITY_BEGIN) == int(kUnityProfilerMarkerEventTypeBegin), "beginnings have another number");
static_assert(int(UNITY_END) == int(kUnityProfilerMarkerEventTypeEnd), "ends have another number");

static int differs(const char *name, UnityInterfaceGUID theirs, unsigned long long high, unsigned long long low) {
    if (theirs.m_GUIDHigh == high && theirs.m_GUIDLow == low) {
        return 0;
    }
    std::printf("%s: Unity's GUID is %016llx %016llx, ours %016llx %016llx\n", name, theirs.m_GUIDHigh,
                theirs.m_GUIDLow, high, low);
    return 1;
}

int main() {
    return differs("IUnityLog", GetUnityInterfaceGUID<IUnityLog>(), UNITY_LOG_HIGH, UNITY_LOG_LOW) |
           differs("IUnityProfiler", GetUnityInterfaceGUID<IUnityProfiler>(), UNITY_PROFILER_HIGH, UNITY_PROFILER_LOW);
}
