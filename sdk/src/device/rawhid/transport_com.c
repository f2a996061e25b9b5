/* Serial ports on Windows. SPDX-License-Identifier: MIT */
#include "device/rawhid/serial.h"

#if defined(_WIN32)

#include <windows.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define WRITE_MS  10 /* a line takes well below 1 ms */
#define INSTANCES 64

typedef struct com {
    HANDLE handle;
    int patience; /* ms: the timeout of reads that was set last; -1: unknown */
} com;

/* Sets how long ReadFile() waits for a first byte; it returns all bytes that have come. 0: the port is gone. */
static int set_patience(com *c, int milliseconds) {
    const DWORD wait = milliseconds > 0 ? (DWORD)milliseconds : 0;
    COMMTIMEOUTS times = {MAXDWORD, wait ? MAXDWORD : 0, wait, 0, WRITE_MS};
    if (c->patience == milliseconds) {
        return 1;
    }
    const int is_set = SetCommTimeouts(c->handle, &times) != 0;
    c->patience = is_set ? milliseconds : -1;
    return is_set;
}

static int com_write(void *self, const char *text, size_t size) {
    const com *c = self;
    DWORD sent = 0;
    return WriteFile(c->handle, text, (DWORD)size, &sent, NULL) && sent == size;
}

static int com_read(void *self, char *text, size_t room, int milliseconds) {
    com *c = self;
    DWORD got = 0;
    return set_patience(c, milliseconds) && ReadFile(c->handle, text, (DWORD)room, &got, NULL) ? (int)got : -1;
}

static void com_close(void *self) {
    com *c = self;
    (void)CloseHandle(c->handle);
    free(c);
}

/* Raw bytes in both directions; USB ignores the speed. */
static int set_raw(com *c) {
    DCB state = {.DCBlength = sizeof state};
    if (!GetCommState(c->handle, &state) ||
        !BuildCommDCBA("baud=115200 parity=N data=8 stop=1 xon=off octs=off odsr=off idsr=off dtr=on rts=on", &state)) {
        return 0;
    }
    state.fNull = state.fAbortOnError = FALSE;
    return SetCommState(c->handle, &state) && PurgeComm(c->handle, PURGE_RXCLEAR | PURGE_TXCLEAR) && set_patience(c, 0);
}

static const char *reason_of(DWORD code) {
    switch (code) {
    case ERROR_FILE_NOT_FOUND:
        return "there is no such port";
    case ERROR_ACCESS_DENIED:
        return "another program uses it; end that program";
    case ERROR_INVALID_HANDLE:
    case ERROR_INVALID_FUNCTION:
        return "expected a serial port, such as " KNURL_SERIAL_EXAMPLE;
    default:
        return "its driver refused it";
    }
}

/* Windows opens a port for one program at a time. */
static int com_open(void *user, const char *path, knurl_serial_wire *wire, char *why, size_t why_size) {
    char name[KNURL_URI_ROOM + 4];
    (void)user;
    com *made = malloc(sizeof *made);
    if (!made) {
        (void)snprintf(why, why_size, "no memory");
        return 0;
    }
    /* ports from COM10 on need the prefix */
    (void)snprintf(name, sizeof name, "%s%s", strncmp(path, "\\\\", 2) == 0 ? "" : "\\\\.\\", path);
    made->handle = CreateFileA(name, GENERIC_READ | GENERIC_WRITE, 0, NULL, OPEN_EXISTING, 0, NULL);
    made->patience = -1;
    if (made->handle == INVALID_HANDLE_VALUE || !set_raw(made)) {
        const DWORD code = GetLastError();
        (void)snprintf(why, why_size, "%s (Windows' error %lu)", reason_of(code), (unsigned long)code);
        if (made->handle != INVALID_HANDLE_VALUE) {
            (void)CloseHandle(made->handle);
        }
        free(made);
        return 0;
    }
    const knurl_serial_wire opened = {made, com_write, com_read, com_close};
    *wire = opened;
    return 1;
}

/* Reads the name of a USB device's port. Returns 0 if the device is not connected: its key stays in the registry. */
static int read_name(HKEY model, const char *instance, char *name, size_t size) {
    char key[300];
    char target[300];
    DWORD room = (DWORD)size;
    (void)snprintf(key, sizeof key, "%s\\Device Parameters", instance);
    return RegGetValueA(model, key, "PortName", RRF_RT_REG_SZ, NULL, name, &room) == ERROR_SUCCESS &&
           QueryDosDeviceA(name, target, sizeof target) > 0;
}

/* The registry has a key for each USB device that was ever connected. */
static int com_find(void *user, char *path, size_t size) {
    char key[80];
    char instance[256];
    HKEY model;
    int found = 0;
    (void)user;
    (void)snprintf(key, sizeof key, "SYSTEM\\CurrentControlSet\\Enum\\USB\\VID_%04X&PID_%04X", KNURL_SERIAL_VENDOR,
                   KNURL_SERIAL_PRODUCT);
    if (RegOpenKeyExA(HKEY_LOCAL_MACHINE, key, 0, KEY_READ, &model) != ERROR_SUCCESS) {
        return 0;
    }
    for (DWORD i = 0; i < INSTANCES && !found; i++) {
        DWORD room = sizeof instance;
        if (RegEnumKeyExA(model, i, instance, &room, NULL, NULL, NULL, NULL) != ERROR_SUCCESS) {
            break;
        }
        found = read_name(model, instance, path, size);
    }
    (void)RegCloseKey(model);
    return found;
}

const knurl_serial_ports *knurl_serial_system(void) {
    static const knurl_serial_ports ports = {NULL, com_find, com_open};
    return &ports;
}

#else

typedef int nothing_on_other_systems; /* ISO C has no empty translation unit */

#endif
