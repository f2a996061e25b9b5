// Knurl: no exception leaves the C functions of the glTF library.
// SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_GUARDED_HPP
#define KNURL_GLTF_GUARDED_HPP

#include "file/failure.hpp"

#include <new>

namespace knurl::gltf {

/** Runs `work` and turns exceptions into a result and a message that starts with the file's name. */
template <typename Work>
knurl_result guarded(const char *name, const Work &work) {
    const char *file = name != nullptr && *name != '\0' ? name : "glTF data";
    try {
        work();
        return KNURL_OK;
    } catch (const Failure &failure) {
        return knurl_fail(failure.code(), "%.400s: %s", file, failure.what());
    } catch (const std::bad_alloc &) {
        return knurl_fail(KNURL_ERROR_MEMORY, "%.400s: out of memory", file);
    } catch (const std::exception &error) {
        return knurl_fail(KNURL_ERROR_FORMAT, "%.400s: %s", file, error.what());
    } catch (...) {
        return knurl_fail(KNURL_ERROR_FORMAT, "%.400s: an unknown failure", file);
    }
}

/** Whether a required argument is missing; sets the error message. */
template <typename T>
bool is_null(T *pointer, const char *name) {
    if (pointer == nullptr)
        (void)knurl_fail(KNURL_ERROR_ARGUMENT, "%s: expected a pointer, found null", name);
    return pointer == nullptr;
}

} // namespace knurl::gltf
#endif
