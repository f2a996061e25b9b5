/* A stand-in for Unity's header of this name, which is under Unity's own licence and is not here: only what
 * test_headers.cpp asks of it, written from what is documented, so that the comparison itself is known to work.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_UNITY_INTERFACE_H
#define KNURL_TEST_UNITY_INTERFACE_H

#if defined(_WIN32)
#define UNITY_INTERFACE_API __stdcall
#else
#define UNITY_INTERFACE_API
#endif

struct UnityInterfaceGUID {
    UnityInterfaceGUID(unsigned long long high, unsigned long long low) : m_GUIDHigh(high), m_GUIDLow(low) {}
    unsigned long long m_GUIDHigh;
    unsigned long long m_GUIDLow;
};

struct IUnityInterface {};

template <typename INTERFACE>
inline UnityInterfaceGUID GetUnityInterfaceGUID();

struct IUnityInterfaces {
    IUnityInterface *(UNITY_INTERFACE_API *GetInterface)(UnityInterfaceGUID guid);
    void(UNITY_INTERFACE_API *RegisterInterface)(UnityInterfaceGUID guid, IUnityInterface *pointer);
    IUnityInterface *(UNITY_INTERFACE_API *GetInterfaceSplit)(unsigned long long high, unsigned long long low);
    void(UNITY_INTERFACE_API *RegisterInterfaceSplit)(unsigned long long high, unsigned long long low,
                                                      IUnityInterface *pointer);
};

#endif
