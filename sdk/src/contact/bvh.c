/* Binned surface-area-heuristic build (Wald 2007), with an explicit stack. SPDX-License-Identifier: MIT */
#include "contact/bvh.h"

#include <string.h>

#define BINS      16
#define SAH_DEPTH 32 /* deeper, runs are halved: 2^26 triangles then end before KNURL_BVH_MAX_DEPTH */

typedef knurl_box box;

typedef struct item {
    box bounds;
    uint32_t place;
} item;

typedef struct range {
    uint32_t begin, end;
    uint32_t parent; /* whose right child this is, or UINT32_MAX */
    uint32_t depth;
} range;

typedef struct split {
    int axis; /* -1: none */
    float low, scale;
    uint32_t bin; /* items in bins below it go left */
} split;

static const box empty_box = {{3e38f, 3e38f, 3e38f}, {-3e38f, -3e38f, -3e38f}};

static void box_add(box *into, const box *other) {
    for (int axis = 0; axis < 3; axis++) {
        into->min[axis] = other->min[axis] < into->min[axis] ? other->min[axis] : into->min[axis];
        into->max[axis] = other->max[axis] > into->max[axis] ? other->max[axis] : into->max[axis];
    }
}

static double box_area(const box *b) {
    const double x = (double)b->max[0] - (double)b->min[0];
    const double y = (double)b->max[1] - (double)b->min[1];
    const double z = (double)b->max[2] - (double)b->min[2];
    return x < 0.0 ? 0.0 : x * y + y * z + z * x;
}

static float centre(const item *i, int axis) {
    return 0.5f * i->bounds.min[axis] + 0.5f * i->bounds.max[axis];
}

static uint32_t bin_of(const item *i, const split *s) {
    const float bin = (centre(i, s->axis) - s->low) * s->scale;
    return bin < 0.0f ? 0 : bin >= (float)(BINS - 1) ? BINS - 1 : (uint32_t)bin;
}

/* The cheapest of the 15 splits between the bins of one axis; its cost, or `best` where none is cheaper. */
static double try_axis(const item *items, const range *r, split candidate, double best, split *chosen) {
    box bounds[BINS];
    uint32_t counts[BINS] = {0};
    double right_area[BINS];
    for (int i = 0; i < BINS; i++) {
        bounds[i] = empty_box;
    }
    for (uint32_t i = r->begin; i < r->end; i++) {
        const uint32_t bin = bin_of(&items[i], &candidate);
        box_add(&bounds[bin], &items[i].bounds);
        counts[bin]++;
    }
    box sweep = empty_box;
    for (int i = BINS - 1; i > 0; i--) {
        box_add(&sweep, &bounds[i]);
        right_area[i] = box_area(&sweep);
    }
    sweep = empty_box;
    uint32_t left = 0;
    for (uint32_t i = 1; i < BINS; i++) {
        box_add(&sweep, &bounds[i - 1]);
        left += counts[i - 1];
        const uint32_t right = r->end - r->begin - left;
        const double cost = box_area(&sweep) * left + right_area[i] * right;
        if (left > 0 && right > 0 && cost < best) {
            best = cost;
            *chosen = candidate;
            chosen->bin = i;
        }
    }
    return best;
}

static split choose_split(const item *items, const range *r) {
    split chosen = {-1, 0.0f, 0.0f, 0};
    box centres = empty_box;
    for (uint32_t i = r->begin; i < r->end; i++) {
        for (int axis = 0; axis < 3; axis++) {
            const float c = centre(&items[i], axis);
            centres.min[axis] = c < centres.min[axis] ? c : centres.min[axis];
            centres.max[axis] = c > centres.max[axis] ? c : centres.max[axis];
        }
    }
    double best = 1e300;
    for (int axis = 0; axis < 3; axis++) {
        const float extent = centres.max[axis] - centres.min[axis];
        if (extent > 1e-30f) { /* below, a bin's inverse is no float */
            const split candidate = {axis, centres.min[axis], (float)BINS * 0.999f / extent, 0};
            best = try_axis(items, r, candidate, best, &chosen);
        }
    }
    return chosen;
}

/* Moves the left side's items to the front; returns where the right side begins. */
static uint32_t partition(item *items, const range *r, const split *s) {
    uint32_t left = r->begin;
    for (uint32_t i = r->begin; i < r->end; i++) {
        if (bin_of(&items[i], s) < s->bin) {
            const item moved = items[i];
            items[i] = items[left];
            items[left++] = moved;
        }
    }
    return left;
}

/* Writes the node of one range; returns where to split it, or r->end for a leaf. */
static uint32_t make_node(item *items, const range *r, uint32_t leaf_size, knurl_bvh_node *node) {
    box bounds = empty_box;
    for (uint32_t i = r->begin; i < r->end; i++) {
        box_add(&bounds, &items[i].bounds);
    }
    memcpy(node->min, bounds.min, sizeof node->min);
    memcpy(node->max, bounds.max, sizeof node->max);
    const uint32_t count = r->end - r->begin;
    split s = {-1, 0.0f, 0.0f, 0};
    if (count > leaf_size && r->depth < SAH_DEPTH) {
        s = choose_split(items, r);
    }
    if (s.axis >= 0) {
        return partition(items, r, &s);
    }
    return count > leaf_size ? r->begin + count / 2 : r->end; /* all centres alike, or very deep: halve */
}

static uint32_t build(item *items, uint32_t count, uint32_t leaf_size, knurl_bvh_node *nodes) {
    range stack[KNURL_BVH_MAX_DEPTH + 1];
    uint32_t top = 0;
    uint32_t node_count = 0;
    stack[top++] = (range){0, count, UINT32_MAX, 0};
    while (top > 0) {
        const range r = stack[--top];
        const uint32_t index = node_count++;
        knurl_bvh_node *node = &nodes[index];
        if (r.parent != UINT32_MAX) {
            nodes[r.parent].first = index;
        }
        const uint32_t middle = make_node(items, &r, leaf_size, node);
        if (middle == r.end) {
            node->first = r.begin;
            node->count = r.end - r.begin;
            continue;
        }
        node->count = 0;
        stack[top++] = (range){middle, r.end, index, r.depth + 1};
        stack[top++] = (range){r.begin, middle, UINT32_MAX, r.depth + 1}; /* the left child comes right next */
    }
    return node_count;
}

knurl_result knurl_bvh_build(knurl_heap *heap, const knurl_box *boxes, uint32_t count, uint32_t leaf_size,
                             uint32_t *order, knurl_bvh_node **nodes, uint32_t *node_count) {
    item *items = knurl_heap_alloc(heap, count, sizeof *items);
    knurl_bvh_node *scratch = knurl_heap_alloc(heap, 2 * (uint64_t)count, sizeof *scratch);
    knurl_bvh_node *made = NULL;
    if (items && scratch) {
        for (uint32_t i = 0; i < count; i++) {
            items[i].bounds = boxes[i];
            items[i].place = i;
        }
        const uint32_t used = build(items, count, leaf_size, scratch);
        made = knurl_heap_alloc(heap, used, sizeof *made); /* to size: half of the scratch is rarely needed */
        if (made) {
            memcpy(made, scratch, used * sizeof *made);
            for (uint32_t i = 0; i < count; i++) {
                order[i] = items[i].place;
            }
            *nodes = made;
            *node_count = used;
        }
    }
    knurl_heap_free(heap, scratch);
    knurl_heap_free(heap, items);
    return made ? KNURL_OK : KNURL_ERROR_MEMORY;
}
