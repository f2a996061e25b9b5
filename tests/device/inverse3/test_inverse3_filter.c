/* The filter of a connection, over real WebSockets to the emulated service. SPDX-License-Identifier: MIT */
#include "support/suite.h"

#include "base/system.h"
#include "device/inverse3/channel.h"

#include <stdlib.h>
#include <string.h>

static int port;

/* In the service's first message only. */
static int has_configuration(const void *self, const char *text, size_t size) {
    static const char key[] = "\"config\"";
    (void)self;
    for (size_t i = 0; i + sizeof key - 1 <= size; i++) {
        if (memcmp(text + i, key, sizeof key - 1) == 0) {
            return 1;
        }
    }
    return 0;
}

/* Connects and sends some commands, each of which is answered. Returns the count of received messages, and whether the
 * newest is the first that was sent. */
static int receive_after_answers(knurl_inverse3_filter filter, int *is_first) {
    static const double none[3];
    char text[KNURL_INVERSE3_COMMAND];
    char why[160] = "";
    knurl_inverse3_message message = {NULL, 0};
    knurl_inverse3_channel channel;
    const knurl_inverse3_service *service = knurl_inverse3_websocket(why, sizeof why);
    if (!service || !service->connect(service->user, port, filter, &channel, why, sizeof why)) {
        fail_msg("%s", why);
        return 0;
    }
    for (int i = 0; i < 50; i++) {
        knurl_system_sleep_until_ns(knurl_system_now_ns() + 10000000);
        assert_int_equal(channel.send(channel.self, text, knurl_inverse3_command(text, "049D", none, "")), 1);
    }
    const int count = channel.receive(channel.self, 1000, &message);
    *is_first = count > 0 && has_configuration(NULL, message.text, message.size);
    channel.close(channel.self);
    return count;
}

TEST(a_message_that_the_filter_takes_is_not_replaced_by_others) {
    const knurl_inverse3_filter filter = {has_configuration, NULL};
    int is_first = 0;
    assert_int_equal(receive_after_answers(filter, &is_first), 1);
    assert_true(is_first);
}

TEST(without_a_filter_the_newest_message_is_received) {
    const knurl_inverse3_filter none = {NULL, NULL};
    int is_first = 1;
    assert_true(receive_after_answers(none, &is_first) > 1);
    assert_false(is_first);
}

int main(int count, char **arguments) {
    port = count > 1 ? (int)strtol(arguments[1], NULL, 10) : 0;
    return suite_run("inverse3_filter");
}
