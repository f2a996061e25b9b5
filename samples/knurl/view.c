/* One thread serves the page by HTTP and the ticks by WebSocket. The haptic thread's ticks arrive through a ring that
 * drops ticks if it is full; this thread keeps the last ones as rows, and each viewer has its own position in them, so
 * that a slow viewer misses rows and does not delay the others. SPDX-License-Identifier: MIT */
#include "view.h"

#include "tick_ring.h"
#include "tool.h"

#include <libwebsockets.h>

#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#define PERIOD_MS    16
#define KEPT_ROWS    4096 /* 0.4 s at 10 kHz */
#define MESSAGE_ROWS 512
#define TOKEN        32 /* hexadecimal digits: 128 bits */
#define CONNECTIONS  32
#define STRANGERS    8 /* connections that have not sent the token yet */
#define PATIENCE_S   5 /* for a request's headers */

/* Sent with every response. The page loads nothing from other hosts, even if the scene's file names them; its images
 * come from the file.
 */
#define SECURITY                                                                                                        \
    "cache-control: no-store\r\nreferrer-policy: no-referrer\r\nx-content-type-options: nosniff\r\n"                    \
    "x-frame-options: DENY\r\ncontent-security-policy: default-src 'none'; script-src 'self'; style-src 'self'; "       \
    "img-src 'self' data: blob:; connect-src 'self' data: blob: ws://%s ws://%s; base-uri 'none'; form-action 'none'; " \
    "frame-ancestors 'none'\r\n"

struct view {
    view_desc desc;
    tick_ring ring;
    knurl_surface_id *surfaces;
    uint32_t surface_count, last_surface;
    char *hello; /* JSON, the first message to each viewer; LWS_PRE bytes precede the text */
    size_t hello_size;
    struct lws_context *context;
    lws_sorted_usec_list_t timer;
    lws_usec_t due; /* expiry of the timer */
    pthread_t thread;
    int stop;        /* atomic */
    char page[4096]; /* the desc's, copied */
    char token[TOKEN + 1], url[96], hosts[2][32], security[640];
    struct lws *strangers[STRANGERS]; /* the oldest first */
    int stranger_count;
    uint64_t row_count; /* so far */
    double rows[KEPT_ROWS][VIEW_ROW];
    unsigned char message[LWS_PRE + MESSAGE_ROWS * VIEW_ROW * sizeof(double)];
};

typedef struct viewer {
    uint64_t next; /* row to send */
    int greeted;
} viewer;

static double surface_index(view *v, knurl_surface_id id) {
    for (uint32_t i = 0; id && i < v->surface_count; i++) {
        const uint32_t at = (v->last_surface + i) % v->surface_count;
        if (v->surfaces[at] == id) {
            v->last_surface = at;
            return at;
        }
    }
    return -1.0;
}

static void fill_row(view *v, const knurl_tick_output *o, double row[VIEW_ROW]) {
    const double rest[] = {o->depth,
                           o->height,
                           o->temporal_frequency,
                           o->cycles[0],
                           o->cycles[1],
                           (o->flags & KNURL_TICK_CONTACT) != 0,
                           surface_index(v, o->surface),
                           (double)o->tick / v->desc.rate,
                           o->surface_velocity[0],
                           o->surface_velocity[1],
                           o->spatial_frequency,
                           o->normal[0],
                           o->normal[1],
                           o->normal[2]};
    memcpy(row, o->force, sizeof o->force);
    memcpy(row + 3, o->hip, sizeof o->hip);
    memcpy(row + 6, o->proxy, sizeof o->proxy);
    memcpy(row + 9, rest, sizeof rest);
}

/* --- who may connect --- */

static int header_is(struct lws *wsi, enum lws_token_indexes header, const char *scheme, const view *v) {
    char found[64];
    char expected[64];
    if (lws_hdr_copy(wsi, found, (int)sizeof found, header) <= 0) {
        return 0; /* missing, or longer than either */
    }
    for (int i = 0; i < 2; i++) {
        (void)snprintf(expected, sizeof expected, "%s%s", scheme, v->hosts[i]);
        if (strcmp(found, expected) == 0) {
            return 1;
        }
    }
    return 0;
}

static void forget(view *v, const struct lws *wsi) {
    int kept = 0;
    for (int i = 0; i < v->stranger_count; i++) {
        if (v->strangers[i] != wsi) {
            v->strangers[kept++] = v->strangers[i];
        }
    }
    v->stranger_count = kept;
}

/* The number of connections without the token is limited: the oldest is closed, so that requests that never end cannot
 * lock others out. */
static void admit(view *v, struct lws *wsi) {
    if (v->stranger_count == STRANGERS) {
        lws_set_timeout(v->strangers[0], PENDING_TIMEOUT_AWAITING_SERVER_RESPONSE, LWS_TO_KILL_ASYNC);
        forget(v, v->strangers[0]);
    }
    v->strangers[v->stranger_count++] = wsi;
}

/* The part of a path after "/TOKEN/", or null. A page of another site may find the port, and may have the same origin
 * through a name that resolves to 127.0.0.1; but it lacks the token, and its Host header names the other site. */
static const char *asked_for(struct lws *wsi, const view *v, const char *path) {
    const int knows =
        strlen(path) > TOKEN + 1 && path[TOKEN + 1] == '/' && lws_timingsafe_bcmp(path + 1, v->token, TOKEN) == 0;
    return knows && header_is(wsi, WSI_TOKEN_HOST, "", v) ? path + TOKEN + 2 : NULL;
}

/* --- HTTP: the scene's file and the page's, by name --- */

static int serve_file(struct lws *wsi, const view *v, const char *path, const char *type) {
    const int sent = lws_serve_http_file(wsi, path, type, v->security, (int)strlen(v->security));
    return sent < 0 || (sent > 0 && lws_http_transaction_completed(wsi)) ? -1 : 0; /* 0: the library sends the rest */
}

static int refuse(struct lws *wsi, const view *v, unsigned status, const char *why) {
    unsigned char text[LWS_PRE + 1024];
    unsigned char *const begin = text + LWS_PRE;
    unsigned char *end = begin;
    unsigned char *const room = text + sizeof text;
    const size_t size = strlen(why);
    if (lws_add_http_common_headers(wsi, status, "text/plain", size, &end, room) ||
        (size_t)(room - end) < strlen(v->security)) {
        return -1;
    }
    memcpy(end, v->security, strlen(v->security));
    end += strlen(v->security);
    if (lws_finalize_write_http_header(wsi, begin, &end, room)) {
        return -1;
    }
    memcpy(begin, why, size);
    return lws_write(wsi, begin, size, LWS_WRITE_HTTP_FINAL) < 0 || lws_http_transaction_completed(wsi) ? -1 : 0;
}

static int answer(struct lws *wsi, view *v, const char *path) {
    static const struct {
        const char *name, *type;
    } files[] = {{"index.html", "text/html"},
                 {"start.js", "text/javascript"},
                 {"main.js", "text/javascript"},
                 {"view.js", "text/javascript"},
                 {"style.css", "text/css"}};
    const char *name = asked_for(wsi, v, path);
    char file[4096];
    if (!name) {
        return refuse(wsi, v, HTTP_STATUS_FORBIDDEN, "not the URL that knurl printed");
    }
    forget(v, wsi);
    if (strcmp(name, "scene") == 0) {
        return serve_file(wsi, v, v->desc.file, "application/octet-stream");
    }
    name = name[0] ? name : "index.html";
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        if (strcmp(name, files[i].name) == 0 &&
            (size_t)snprintf(file, sizeof file, "%s/%s", v->desc.page, name) < sizeof file && access(file, R_OK) == 0) {
            return serve_file(wsi, v, file, files[i].type);
        }
    }
    const char *why = strcmp(name, "index.html") == 0 ? "the page is not built: ./run web builds it" : "no such file";
    return refuse(wsi, v, HTTP_STATUS_NOT_FOUND, why);
}

static int on_http(struct lws *wsi, enum lws_callback_reasons reason, void *user, void *in, size_t size) {
    view *v = lws_context_user(lws_get_context(wsi));
    switch ((int)reason) {
    case LWS_CALLBACK_SERVER_NEW_CLIENT_INSTANTIATED:
        admit(v, wsi);
        return 0;
    case LWS_CALLBACK_WSI_DESTROY:
        forget(v, wsi);
        return 0;
    case LWS_CALLBACK_HTTP:
        return answer(wsi, v, in);
    case LWS_CALLBACK_FILTER_PROTOCOL_CONNECTION: /* a WebSocket without our protocol */
        return 1;
    default:
        return lws_callback_http_dummy(wsi, reason, user, in, size);
    }
}

/* --- WebSocket: the ticks --- */

static int may_watch(struct lws *wsi, const view *v) {
    char path[TOKEN + 16];
    const char *name =
        lws_hdr_copy(wsi, path, (int)sizeof path, WSI_TOKEN_GET_URI) > 0 ? asked_for(wsi, v, path) : NULL;
    return name && strcmp(name, "live") == 0 && header_is(wsi, WSI_TOKEN_ORIGIN, "http://", v);
}

static int send_rows(struct lws *wsi, view *v, viewer *to) {
    if (!to->greeted) {
        to->greeted = 1;
        return lws_write(wsi, (unsigned char *)v->hello + LWS_PRE, v->hello_size, LWS_WRITE_TEXT) < 0 ? -1 : 0;
    }
    if (v->row_count - to->next > KEPT_ROWS) { /* the viewer was too slow */
        to->next = v->row_count - KEPT_ROWS;
    }
    const uint64_t waiting = v->row_count - to->next;
    const size_t count = waiting < MESSAGE_ROWS ? (size_t)waiting : MESSAGE_ROWS;
    const size_t row_size = sizeof v->rows[0];
    for (size_t i = 0; i < count; i++) {
        memcpy(v->message + LWS_PRE + i * row_size, v->rows[(to->next + i) % KEPT_ROWS], row_size);
    }
    to->next += count;
    if (count < waiting) {
        (void)lws_callback_on_writable(wsi);
    }
    return count > 0 && lws_write(wsi, v->message + LWS_PRE, count * row_size, LWS_WRITE_BINARY) < 0 ? -1 : 0;
}

static int on_live(struct lws *wsi, enum lws_callback_reasons reason, void *user, void *in, size_t size) {
    view *v = lws_context_user(lws_get_context(wsi));
    viewer *who = user;
    (void)in;
    (void)size;
    switch ((int)reason) {
    case LWS_CALLBACK_FILTER_PROTOCOL_CONNECTION:
        return !may_watch(wsi, v);
    case LWS_CALLBACK_ESTABLISHED:
        forget(v, wsi);
        who->next = v->row_count;
        who->greeted = 0;
        (void)lws_callback_on_writable(wsi);
        return 0;
    case LWS_CALLBACK_SERVER_WRITEABLE:
        return send_rows(wsi, v, who);
    case LWS_CALLBACK_RECEIVE: /* the page sends nothing */
        return -1;
    default:
        return 0;
    }
}

/* The last number is the size of a write to the kernel; the default would be the third number, 256 bytes. */
static const struct lws_protocols protocols[] = {
    {"http", on_http, 0, 0, 0, NULL, 0},
    {"knurl", on_live, sizeof(viewer), 256, 0, NULL, MESSAGE_ROWS * VIEW_ROW * sizeof(double)},
    {0}};

/* --- the thread --- */

static void collect(lws_sorted_usec_list_t *timer);

static void start_timer(view *v) {
    v->due = lws_now_usecs() + PERIOD_MS * LWS_US_PER_MS;
    lws_sul_schedule(v->context, 0, &v->timer, collect, PERIOD_MS * LWS_US_PER_MS);
}

static void collect(lws_sorted_usec_list_t *timer) {
    view *v = lws_container_of(timer, view, timer);
    const knurl_tick_output *tick;
    for (int i = 0; i < TICK_RING_ROWS && (tick = tick_ring_first(&v->ring)) != NULL; i++) {
        fill_row(v, tick, v->rows[v->row_count++ % KEPT_ROWS]);
        tick_ring_drop(&v->ring);
    }
    (void)lws_callback_on_writable_all_protocol(v->context, &protocols[1]);
    start_timer(v);
}

/* lws_service() waits for whole milliseconds and would poll repeatedly for the rest of one. */
static void wait_below_a_millisecond(const view *v) {
    const lws_usec_t left = v->due - lws_now_usecs();
    if (left > 0 && left < LWS_US_PER_MS) {
        const struct timespec t = {0, (long)left * 1000};
        (void)nanosleep(&t, NULL);
    }
}

static void *serve(void *user) {
    view *v = user;
    while (!__atomic_load_n(&v->stop, __ATOMIC_ACQUIRE) && lws_service(v->context, 0) >= 0) {
        wait_below_a_millisecond(v);
    }
    return NULL;
}

/* --- start and end --- */

static void describe_surface(json_writer *json, const char *name, const knurl_material_desc *m) {
    const double feel[6] = {
        m->spatial_frequency[0], m->spatial_frequency[1], m->amplitude, m->stiffness, m->friction, m->method};
    json_open(json, NULL, '{');
    json_string(json, "name", name);
    json_numbers(json, "feel", feel, 6, 1);
    json_close(json, '}');
}

static int make_hello(view *v) {
    const char *slash = strrchr(v->desc.file, '/');
    json_writer json;
    FILE *stream = open_memstream(&v->hello, &v->hello_size);
    if (!stream) {
        return 1;
    }
    (void)fseek(stream, LWS_PRE, SEEK_SET);
    json_start(&json, stream, 0);
    json_open(&json, NULL, '{');
    json_string(&json, "file", slash ? slash + 1 : v->desc.file);
    json_string(&json, "device", v->desc.device);
    json_number(&json, "rate_hz", v->desc.rate);
    json_open(&json, "surfaces", '[');
    for (uint32_t i = 0; i < v->surface_count; i++) {
        char name[KNURL_NAME_SIZE];
        knurl_material_desc material;
        knurl_material_desc_init(&material, sizeof material);
        v->surfaces[i] = knurl_scene_get_surface(v->desc.scene, i);
        if (knurl_scene_get_surface_name(v->desc.scene, v->surfaces[i], name) == KNURL_OK &&
            knurl_scene_get_material(v->desc.scene, v->surfaces[i], &material) == KNURL_OK) {
            describe_surface(&json, name, &material);
        }
    }
    json_close(&json, ']');
    json_close(&json, '}');
    if (fclose(stream) != 0) {
        return 1;
    }
    v->hello_size -= LWS_PRE;
    return 0;
}

/* lws_create_context() makes the process ignore SIGPIPE, so this restores it. The sockets do not raise it:
 * MSG_NOSIGNAL. */
static struct lws_context *make_context(const struct lws_context_creation_info *info) {
    struct sigaction was;
    const int is_known = sigaction(SIGPIPE, NULL, &was) == 0;
    struct lws_context *made = lws_create_context(info);
    if (is_known) {
        (void)sigaction(SIGPIPE, &was, NULL);
    }
    return made;
}

static int listen_on_loopback(view *v) {
    struct lws_context_creation_info info;
    memset(&info, 0, sizeof info);
    info.iface = "127.0.0.1";
    info.port = 0; /* any free port */
    info.protocols = protocols;
    info.options = LWS_SERVER_OPTION_DISABLE_IPV6;
    info.fd_limit_per_thread = CONNECTIONS;
    info.max_http_header_pool = CONNECTIONS; /* by default few requests are read at a time */
    info.timeout_secs = PATIENCE_S;
    info.user = v;
    lws_set_log_level(0, NULL);
    v->context = make_context(&info);
    const int port = v->context ? lws_get_vhost_listen_port(lws_get_vhost_by_name(v->context, "default")) : 0;
    if (port <= 0 || lws_hex_random(v->context, v->token, sizeof v->token)) {
        return 1;
    }
    (void)snprintf(v->hosts[0], sizeof v->hosts[0], "127.0.0.1:%d", port);
    (void)snprintf(v->hosts[1], sizeof v->hosts[1], "localhost:%d", port);
    (void)snprintf(v->security, sizeof v->security, SECURITY, v->hosts[0], v->hosts[1]);
    (void)snprintf(v->url, sizeof v->url, "http://%s/%s/#live", v->hosts[0], v->token);
    return 0;
}

static void destroy(view *v) {
    if (v->context) {
        lws_context_destroy(v->context);
    }
    tick_ring_destroy(&v->ring);
    free(v->surfaces);
    free(v->hello);
    free(v);
}

int view_open(const view_desc *desc, view **opened) {
    view *v = calloc(1, sizeof *v);
    if (!v) {
        return tool_error(TOOL_FAILURE, "run: --view: no memory");
    }
    v->desc = *desc;
    (void)snprintf(v->page, sizeof v->page, "%s", desc->page);
    v->desc.page = v->page;
    v->surface_count = knurl_scene_get_surface_count(desc->scene);
    v->surfaces = calloc(v->surface_count + 1, sizeof *v->surfaces);
    if (!v->surfaces || tick_ring_create(&v->ring) || make_hello(v) || listen_on_loopback(v)) {
        destroy(v);
        return tool_error(TOOL_FAILURE, "run: --view: cannot listen on 127.0.0.1, or no memory");
    }
    start_timer(v);
    if (pthread_create(&v->thread, NULL, serve, v)) {
        destroy(v);
        return tool_error(TOOL_FAILURE, "run: --view: no thread");
    }
    *opened = v;
    return TOOL_OK;
}

const char *view_url(const view *v) {
    return v->url;
}

void view_take(view *v, const knurl_tick_output *output) {
    tick_ring_put(&v->ring, output);
}

void view_close(view *v) {
    if (!v) {
        return;
    }
    __atomic_store_n(&v->stop, 1, __ATOMIC_RELEASE);
    lws_cancel_service(v->context);
    (void)pthread_join(v->thread, NULL);
    if (v->ring.lost > 0) {
        tool_tell("note", "%llu ticks were not shown: there was no time for them", (unsigned long long)v->ring.lost);
    }
    destroy(v);
}
