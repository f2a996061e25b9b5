/* The stub library's functions for tests: settings, questions, reset. SPDX-License-Identifier: MIT */
#include "stub_state.h"

#include "support/double.h"

void stub_set(int device, int setting, double value) {
    lock();
    hd.devices[device].settings[setting] = value;
    hd.settings[setting] = value;
    if (setting == STUB_LOOSE) {
        double_hold(&hd.devices[device].plant, value == 0.0);
    }
    if (setting == STUB_ERRORS && value >= 0.0) {
        hd.endless = 0;
        hd.error_count = 0;
    }
    unlock();
}

double stub_ask(int device, int question) {
    lock();
    double answer = hd.devices[device].answers[question];
    if (question == STUB_DEPTH) {
        answer = -hd.devices[device].plant.position[1];
    } else if (question == STUB_RUNNING) {
        answer = hd.runs;
    } else if (question == STUB_RATE) {
        answer = hd.rate;
    } else if (question == STUB_CALLBACKS) {
        answer = 0.0;
        for (int i = 0; i < LIST; i++) {
            answer += hd.list[i].callback != NULL;
        }
    } else if (question >= STUB_MISUSES) {
        answer = hd.answers[question];
    }
    unlock();
    return answer;
}

int64_t stub_limp_since(int device) {
    lock();
    const int64_t since = hd.devices[device].limp_since;
    unlock();
    return since;
}

void stub_use_time(const stub_time *time) {
    hd.time = *time;
}

void stub_reset(void) {
    lock();
    memset(hd.devices, 0, sizeof hd.devices);
    memset(hd.settings, 0, sizeof hd.settings);
    memset(hd.answers, 0, sizeof hd.answers);
    memset(hd.list, 0, sizeof hd.list);
    hd.error_count = 0;
    hd.endless = 0;
    hd.current = NONE;
    hd.rate = 1000.0;
    unlock();
}
