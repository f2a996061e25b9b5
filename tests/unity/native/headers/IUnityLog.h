/* A stand-in for Unity's header of this name: see IUnityInterface.h. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_UNITY_LOG_H
#define KNURL_TEST_UNITY_LOG_H

#include "IUnityInterface.h"

enum UnityLogType {
    kUnityLogTypeError = 0,
    kUnityLogTypeWarning = 2,
    kUnityLogTypeLog = 3,
    kUnityLogTypeException = 4
};

struct IUnityLog : IUnityInterface {
    void(UNITY_INTERFACE_API *Log)(UnityLogType type, const char *message, const char *file, const int line);
};

template <>
inline UnityInterfaceGUID GetUnityInterfaceGUID<IUnityLog>() {
    return UnityInterfaceGUID(0x9E7507FA5B444D5DULL, 0x92FB979515EA83FCULL);
}

#endif
