/* hidapi asks cfgmgr32.dll for the HID devices; the wine of Debian 12 lacks these functions and has setupapi's. Put it
 * beside a program, with WINEDLLOVERRIDES=cfgmgr32=n,b. Functions that hidapi can do without fail.
 * SPDX-License-Identifier: MIT
 */
#include <windows.h> /* before setupapi.h, which needs it */

#include <setupapi.h>
#include <wchar.h>

#define DONE    0x00 /* CR_SUCCESS */
#define REFUSED 0x13 /* CR_FAILURE */

/* NOLINTBEGIN(readability-identifier-naming): Windows' names */
__declspec(dllexport) DWORD WINAPI CM_Get_Device_Interface_List_SizeW(ULONG *size, GUID *kind, wchar_t *id,
                                                                      ULONG flags);
__declspec(dllexport) DWORD WINAPI CM_Get_Device_Interface_ListW(GUID *kind, wchar_t *id, wchar_t *list, ULONG size,
                                                                 ULONG flags);
__declspec(dllexport) DWORD WINAPI CM_Locate_DevNodeW(void);
__declspec(dllexport) DWORD WINAPI CM_Get_Parent(void);
__declspec(dllexport) DWORD WINAPI CM_Get_DevNode_PropertyW(void);
__declspec(dllexport) DWORD WINAPI CM_Get_Device_Interface_PropertyW(void);

/* Paths with a 0 after each, and one after all. Returns the characters that it takes; null: only that. */
static ULONG put_paths(GUID *kind, wchar_t *list, ULONG room) {
    HDEVINFO set = SetupDiGetClassDevsW(kind, NULL, NULL, DIGCF_DEVICEINTERFACE | DIGCF_PRESENT);
    SP_DEVICE_INTERFACE_DATA found = {.cbSize = sizeof found};
    ULONG used = 0;
    for (DWORD i = 0; SetupDiEnumDeviceInterfaces(set, NULL, kind, i, &found); i++) {
        union {
            SP_DEVICE_INTERFACE_DETAIL_DATA_W detail;
            char room[2048];
        } u;
        u.detail.cbSize = sizeof u.detail;
        if (SetupDiGetDeviceInterfaceDetailW(set, &found, &u.detail, sizeof u, NULL, NULL)) {
            const ULONG length = (ULONG)wcslen(u.detail.DevicePath) + 1;
            if (list && used + length < room) {
                wmemcpy(list + used, u.detail.DevicePath, length);
            }
            used += length;
        }
    }
    (void)SetupDiDestroyDeviceInfoList(set);
    if (list && used < room) {
        list[used] = L'\0';
    }
    return used + 1;
}

DWORD WINAPI CM_Get_Device_Interface_List_SizeW(ULONG *size, GUID *kind, wchar_t *id, ULONG flags) {
    (void)id;
    (void)flags;
    *size = put_paths(kind, NULL, 0);
    return DONE;
}

DWORD WINAPI CM_Get_Device_Interface_ListW(GUID *kind, wchar_t *id, wchar_t *list, ULONG size, ULONG flags) {
    (void)id;
    (void)flags;
    return put_paths(kind, list, size) <= size ? DONE : REFUSED;
}

DWORD WINAPI CM_Locate_DevNodeW(void) {
    return REFUSED;
}

DWORD WINAPI CM_Get_Parent(void) {
    return REFUSED;
}

DWORD WINAPI CM_Get_DevNode_PropertyW(void) {
    return REFUSED;
}

DWORD WINAPI CM_Get_Device_Interface_PropertyW(void) {
    return REFUSED;
}
/* NOLINTEND(readability-identifier-naming) */
