/* The offset of every field in C# equals that of this system's compiler. Expected offsets are from the mirror, by C#'s
 * rules for sequential layout. SPDX-License-Identifier: MIT */
#include "engine.h"
#include "layout.g.h"

#define STRUCT(type, bytes)                 {#type, "", 0, bytes},
#define FIELD(type, field, name, at, bytes) {#type, name, at, bytes},

static const knurl_unity_layout_row expected[] = {KNURL_UNITY_LAYOUT(STRUCT, FIELD)};

TEST(every_struct_and_field_lies_where_c_sharp_expects_it) {
    plugin p = plugin_open();
    knurl_unity_layout_row row;
    for (uint32_t i = 0; i < COUNT_OF(expected); i++) {
        const knurl_unity_layout_row *wanted = &expected[i];
        assert_int_equal(p.knurl_unity_layout(i, &row), 1);
        assert_string_equal(row.type, wanted->type);
        assert_string_equal(row.field, wanted->field);
        if (row.offset != wanted->offset || row.size != wanted->size) {
            fail_msg("%s.%s: offset %u, %u bytes; C# has %u, %u", row.type, row.field, (unsigned)row.offset,
                     (unsigned)row.size, (unsigned)wanted->offset, (unsigned)wanted->size);
        }
    }
    plugin_close(&p);
}

TEST(beyond_its_end_the_layout_has_nothing_to_tell) {
    plugin p = plugin_open();
    knurl_unity_layout_row row = {"type", "field", 7, 9};
    static const uint32_t beyond[] = {COUNT_OF(expected), COUNT_OF(expected) + 1, UINT32_MAX};
    for (size_t i = 0; i < COUNT_OF(beyond); i++) {
        assert_int_equal(p.knurl_unity_layout(beyond[i], &row), 0);
        assert_string_equal(row.type, "type");
        assert_int_equal(row.size, 9);
    }
    plugin_close(&p);
}

TEST(the_library_and_the_c_sharp_side_name_the_same_interface) {
    plugin p = plugin_open();
    char declared[64] = "";
    char line[256];
    FILE *file = fopen(KNURL_TEST_MIRROR, "r");
    while (file && fgets(line, sizeof line, file)) {
        const char *found = strstr(line, "string Interface = ");
        if (found) {
            (void)snprintf(declared, sizeof declared, "%.18s", strchr(found, '"'));
        }
    }
    if (file) {
        (void)fclose(file);
    }
    (void)snprintf(line, sizeof line, "\"%s\"", p.knurl_unity_interface());
    assert_int_equal(strlen(p.knurl_unity_interface()), 16);
    assert_string_equal(declared, line);
    plugin_close(&p);
}
