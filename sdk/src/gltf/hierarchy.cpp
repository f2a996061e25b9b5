// SPDX-License-Identifier: MIT
#include "hierarchy.hpp"

namespace knurl::gltf {
namespace {

using Children = std::vector<std::vector<uint32_t>>;

std::string node_label(const Fields &root, size_t node) {
    return root.item("nodes", "node", node).where();
}

Children read_children(const Fields &root, size_t count) {
    Children children(count);
    for (size_t i = 0; i < count; ++i)
        children[i] = root.item("nodes", "node", i).indices("children", count, "nodes");
    return children;
}

std::vector<int32_t> find_parents(const Fields &root, const Children &children) {
    std::vector<int32_t> parents(children.size(), -1);
    for (size_t i = 0; i < children.size(); ++i)
        for (const uint32_t child : children[i]) {
            if (child == i)
                refuse(node_label(root, i), "children: the node is its own child");
            if (parents[child] >= 0)
                refuse(node_label(root, child), "is a child of " +
                                                    node_label(root, static_cast<size_t>(parents[child])) +
                                                    " and again of " + node_label(root, i) + ": expected one parent");
            parents[child] = static_cast<int32_t>(i);
        }
    return parents;
}

/// Depth first from `roots`. It ends because each node has one parent, so that no ring hangs below a root.
std::vector<uint32_t> walk(const Fields &root, const Children &children, const std::vector<uint32_t> &roots) {
    struct Step {
        uint32_t node;
        uint32_t depth;
    };
    std::vector<uint32_t> order;
    std::vector<Step> stack;
    for (size_t i = roots.size(); i > 0; --i)
        stack.push_back({roots[i - 1], 1});
    while (!stack.empty()) {
        const Step step = stack.back();
        stack.pop_back();
        if (step.depth > node_depth_max)
            refuse(node_label(root, step.node), "lies more than " + std::to_string(node_depth_max) + " nodes deep");
        order.push_back(step.node);
        const std::vector<uint32_t> &below = children[step.node];
        for (size_t i = below.size(); i > 0; --i)
            stack.push_back({below[i - 1], step.depth + 1});
    }
    return order;
}

/// A node that cannot be reached from a root is in a ring of parents, or below one.
void refuse_rings(const Fields &root, const std::vector<int32_t> &parents, const std::vector<uint32_t> &reached) {
    if (reached.size() == parents.size())
        return;
    std::vector<bool> seen(parents.size(), false);
    for (const uint32_t node : reached)
        seen[node] = true;
    size_t node = 0;
    while (seen[node])
        ++node;
    for (; !seen[node]; node = static_cast<size_t>(parents[node]))
        seen[node] = true;
    refuse(node_label(root, node), "children: the node is its own ancestor");
}

/// The roots of the scene to load: `scene`, else the first scene, else every node without a parent.
std::vector<uint32_t> scene_roots(const Fields &root, const std::vector<int32_t> &parents,
                                  const std::vector<uint32_t> &all_roots) {
    const size_t scenes = root.array("scenes").size();
    const uint32_t chosen = root.index("scene", scenes, "scenes").value_or(0);
    if (scenes == 0)
        return all_roots;
    const Fields scene = root.item("scenes", "scene", chosen);
    std::vector<uint32_t> roots = scene.indices("nodes", parents.size(), "nodes");
    std::vector<bool> seen(parents.size(), false);
    for (const uint32_t node : roots) {
        if (parents[node] >= 0)
            scene.refuse_key("nodes", node_label(root, node) + " is a child of " +
                                          node_label(root, static_cast<size_t>(parents[node])) +
                                          ": expected nodes without a parent");
        if (seen[node])
            scene.refuse_key("nodes", node_label(root, node) + " is listed twice");
        seen[node] = true;
    }
    return roots;
}

} // namespace

Hierarchy read_hierarchy(const Fields &root) {
    const Children children = read_children(root, root.array("nodes").size());
    Hierarchy hierarchy;
    hierarchy.parents = find_parents(root, children);
    std::vector<uint32_t> roots;
    for (size_t i = 0; i < hierarchy.parents.size(); ++i)
        if (hierarchy.parents[i] < 0)
            roots.push_back(static_cast<uint32_t>(i));
    refuse_rings(root, hierarchy.parents, walk(root, children, roots));
    hierarchy.shown = walk(root, children, scene_roots(root, hierarchy.parents, roots));
    return hierarchy;
}

} // namespace knurl::gltf
