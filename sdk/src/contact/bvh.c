/* Binned surface-area-heuristic build (Wald 2007) with an explicit stack. Only the axis with the widest spread of
 * centres is split: a third of the binning. SPDX-License-Identifier: MIT */
#include "contact/bvh.h"

#include <string.h>

#define BINS      16
#define SAH_DEPTH 32 /* deeper ranges are halved, so that 2^26 triangles stay within KNURL_BVH_DEPTH_MAX */

/* Boxes to sort, and their indices before. */
typedef struct items {
    knurl_box *boxes;
    uint32_t *places;
} items;

typedef struct range {
    uint32_t begin, end;
    uint32_t parent; /* the node whose right child this is, or UINT32_MAX */
    uint32_t depth;
} range;

typedef struct split {
    int axis;
    float low, scale;
    uint32_t bin; /* items in lower bins are on the left; 0: no split found */
} split;

typedef struct tree {
    knurl_bvh_node *nodes;
    uint32_t count;
    uint32_t capacity;
} tree;

static const knurl_box empty_box = {{3.4e38f, 3.4e38f, 3.4e38f, 0.0f}, {-3.4e38f, -3.4e38f, -3.4e38f, 0.0f}};

static inline void box_add(knurl_box *into, const knurl_box *other) {
    into->min = knurl_float4_min(other->min, into->min);
    into->max = knurl_float4_max(other->max, into->max);
}

static double box_area(const knurl_box *b) {
    const double x = (double)b->max[0] - (double)b->min[0];
    const double y = (double)b->max[1] - (double)b->min[1];
    const double z = (double)b->max[2] - (double)b->min[2];
    return x < 0.0 ? 0.0 : x * y + y * z + z * x;
}

/* A box's place among the bins; its whole part is the bin. */
static inline float place_in_bins(const knurl_box *b, const split *s) {
    const float middle = 0.5f * b->min[s->axis] + 0.5f * b->max[s->axis];
    const float place = (middle - s->low) * s->scale;
    const float low = place > 0.0f ? place : 0.0f; /* NaN, from huge boxes, is 0 */
    return low < (float)(BINS - 1) ? low : (float)(BINS - 1);
}

/* Computes a range's bounds, and a split along the widest axis of its centres; choose_bin() sets its bin. */
static split measure(const knurl_box *boxes, const range *r, knurl_box *bounds) {
    knurl_box centres = empty_box;
    knurl_box sum = empty_box;
    for (uint32_t i = r->begin; i < r->end; i++) {
        const knurl_float4 middle = 0.5f * boxes[i].min + 0.5f * boxes[i].max;
        const knurl_box at = {middle, middle};
        box_add(&sum, &boxes[i]);
        box_add(&centres, &at);
    }
    *bounds = sum;
    split s = {0, 0.0f, 0.0f, 0};
    float widest = -1.0f;
    for (int axis = 0; axis < 3; axis++) {
        const float extent = centres.max[axis] - centres.min[axis];
        if (extent > widest) {
            widest = extent;
            s.axis = axis;
        }
    }
    s.low = centres.min[s.axis];
    s.scale = widest > 1e-30f ? (float)BINS * 0.999f / widest : 0.0f; /* below, the scale could overflow */
    return s;
}

/* Boxes around the items of each bin. */
typedef struct bins {
    knurl_box bounds[BINS];
    uint32_t counts[BINS];
} bins;

static void clear_bins(bins *b) {
    for (int i = 0; i < BINS; i++) {
        b->bounds[i] = empty_box;
        b->counts[i] = 0;
    }
}

/* Adds a box to its bin, and keeps its place among the bins in it, for partition(). */
static inline void add_to_bin(knurl_box *b, const split *s, bins *into) {
    const float place = place_in_bins(b, s);
    const uint32_t bin = (uint32_t)place;
    box_add(&into->bounds[bin], b);
    into->counts[bin]++;
    b->min[3] = place;
}

/* Boxes that follow each other in the list are often of the same bin, and each addition waits for the one before. A
 * long list is therefore read in STREAMS parts at once, each with bins of its own. Shorter parts take longer to merge.
 */
#define STREAMS      4
#define STREAM_LEAST 64 /* boxes of a part */

static void fill_bins(knurl_box *boxes, const range *r, const split *s, bins *sum) {
    const split constant = *s; /* `boxes` might alias *s */
    const uint32_t count = r->end - r->begin, length = count / STREAMS > STREAM_LEAST ? count / STREAMS : 0;
    bins apart[STREAMS];
    clear_bins(sum);
    for (uint32_t k = 0; k < STREAMS && length > 0; k++) {
        clear_bins(&apart[k]);
    }
    for (uint32_t i = r->begin; i < r->begin + length; i++) {
        for (uint32_t k = 0; k < STREAMS; k++) {
            add_to_bin(&boxes[i + k * length], &constant, &apart[k]);
        }
    }
    for (uint32_t i = r->begin + STREAMS * length; i < r->end; i++) {
        add_to_bin(&boxes[i], &constant, sum);
    }
    for (uint32_t k = 0; k < STREAMS && length > 0; k++) {
        for (int i = 0; i < BINS; i++) {
            box_add(&sum->bounds[i], &apart[k].bounds[i]);
            sum->counts[i] += apart[k].counts[i];
        }
    }
}

/* Picks the cheapest of the 15 splits between bins. */
static void choose_bin(knurl_box *boxes, const range *r, split *s) {
    bins b;
    double right_area[BINS];
    fill_bins(boxes, r, s, &b);
    knurl_box sweep = empty_box;
    double area = 0.0;
    for (int i = BINS - 1; i > 0; i--) {
        if (b.counts[i] > 0) {
            box_add(&sweep, &b.bounds[i]);
            area = box_area(&sweep);
        }
        right_area[i] = area;
    }
    sweep = empty_box;
    uint32_t left = 0;
    double best = 1e300;
    for (uint32_t i = 1; i < BINS; i++) {
        if (b.counts[i - 1] == 0) { /* the same split as the one before */
            continue;
        }
        box_add(&sweep, &b.bounds[i - 1]);
        left += b.counts[i - 1];
        const uint32_t right = r->end - r->begin - left;
        const double cost = box_area(&sweep) * left + right_area[i] * right;
        if (right > 0 && cost < best) {
            best = cost;
            s->bin = i;
        }
    }
}

/* Moves the items of the left side to the front; returns the first index of the right side. */
static uint32_t partition(const items *list, const range *r, const split *s) {
    uint32_t left = r->begin;
    for (uint32_t i = r->begin; i < r->end; i++) {
        if (list->boxes[i].min[3] < (float)s->bin) {
            const knurl_box moved = list->boxes[i];
            const uint32_t place = list->places[i];
            list->boxes[i] = list->boxes[left];
            list->places[i] = list->places[left];
            list->boxes[left] = moved;
            list->places[left++] = place;
        }
    }
    return left;
}

/* Writes a range's node; returns the index to split at, or r->end for a leaf. */
static uint32_t make_node(const items *list, const range *r, uint32_t leaf_size, knurl_bvh_node *node) {
    knurl_box bounds;
    split s = measure(list->boxes, r, &bounds);
    memcpy(node->min, &bounds.min, sizeof node->min);
    memcpy(node->max, &bounds.max, sizeof node->max);
    const uint32_t count = r->end - r->begin;
    if (count <= leaf_size) {
        return r->end;
    }
    if (r->depth < SAH_DEPTH && s.scale > 0.0f) {
        choose_bin(list->boxes, r, &s);
    }
    return s.bin > 0 ? partition(list, r, &s) : r->begin + count / 2; /* equal centres, or very deep: halve */
}

/* Makes room for one more node; 0 if out of memory. */
static int grow(knurl_heap *heap, tree *t) {
    if (t->count < t->capacity) {
        return 1;
    }
    const uint32_t capacity = 2 * t->capacity;
    knurl_bvh_node *nodes = knurl_heap_alloc(heap, capacity, sizeof *nodes);
    if (nodes) {
        memcpy(nodes, t->nodes, t->count * sizeof *nodes);
        knurl_heap_free(heap, t->nodes);
        t->nodes = nodes;
        t->capacity = capacity;
    }
    return nodes != NULL;
}

static int build(knurl_heap *heap, const items *list, uint32_t count, uint32_t leaf_size, tree *t) {
    range stack[KNURL_BVH_DEPTH_MAX + 1];
    uint32_t top = 0;
    stack[top++] = (range){0, count, UINT32_MAX, 0};
    while (top > 0) {
        const range r = stack[--top];
        if (!grow(heap, t)) {
            return 0;
        }
        const uint32_t index = t->count++;
        knurl_bvh_node *node = &t->nodes[index];
        if (r.parent != UINT32_MAX) {
            t->nodes[r.parent].first = index;
        }
        const uint32_t middle = make_node(list, &r, leaf_size, node);
        if (middle == r.end) {
            node->first = r.begin;
            node->count = r.end - r.begin;
            continue;
        }
        node->count = 0;
        stack[top++] = (range){middle, r.end, index, r.depth + 1};
        stack[top++] = (range){r.begin, middle, UINT32_MAX, r.depth + 1}; /* the left child follows its parent */
    }
    return 1;
}

knurl_result knurl_bvh_build(knurl_heap *heap, knurl_box *boxes, uint32_t count, uint32_t leaf_size, uint32_t *order,
                             knurl_bvh_node **nodes, uint32_t *node_count) {
    tree t = {NULL, 0, 2 * (count / leaf_size) + 16}; /* leaves are usually more than half full */
    const items list = {boxes, order};
    t.nodes = knurl_heap_alloc(heap, t.capacity, sizeof *t.nodes);
    knurl_bvh_node *made = NULL;
    for (uint32_t i = 0; i < count; i++) {
        order[i] = i;
    }
    if (t.nodes && build(heap, &list, count, leaf_size, &t)) {
        made = knurl_heap_alloc(heap, t.count, sizeof *made); /* exact size */
    }
    if (made) {
        memcpy(made, t.nodes, t.count * sizeof *made);
        *nodes = made;
        *node_count = t.count;
    }
    knurl_heap_free(heap, t.nodes);
    return made ? KNURL_OK : KNURL_ERROR_MEMORY;
}
