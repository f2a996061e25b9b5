/* A stand-in for Unity's header of this name: see IUnityInterface.h. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_UNITY_PROFILER_H
#define KNURL_TEST_UNITY_PROFILER_H

#include "IUnityInterface.h"

#include <stdint.h>

enum { kUnityProfilerCategoryScripts = 1 };
enum { kUnityProfilerMarkerFlagDefault = 0 };
enum { kUnityProfilerMarkerEventTypeBegin = 0, kUnityProfilerMarkerEventTypeEnd = 1 };

struct UnityProfilerMarkerDesc;
struct UnityProfilerMarkerData;

struct IUnityProfiler : IUnityInterface {
    void(UNITY_INTERFACE_API *EmitEvent)(const UnityProfilerMarkerDesc *marker, uint16_t event, uint16_t data_count,
                                         const UnityProfilerMarkerData *data);
    int(UNITY_INTERFACE_API *IsEnabled)();
    int(UNITY_INTERFACE_API *IsAvailable)();
    int(UNITY_INTERFACE_API *CreateMarker)(const UnityProfilerMarkerDesc **marker, const char *name, uint16_t category,
                                           uint16_t flags, int data_count);
    int(UNITY_INTERFACE_API *SetMarkerMetadataName)(const UnityProfilerMarkerDesc *marker, int index, const char *name,
                                                    uint8_t type, uint8_t unit);
    int(UNITY_INTERFACE_API *RegisterThread)(uint64_t *thread, const char *group, const char *name);
    int(UNITY_INTERFACE_API *UnregisterThread)(uint64_t thread);
};

template <>
inline UnityInterfaceGUID GetUnityInterfaceGUID<IUnityProfiler>() {
    return UnityInterfaceGUID(0x2CE79ED8316A4833ULL, 0x87076B2013E1571FULL);
}

#endif
