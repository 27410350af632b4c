/* core/guard.hpp - the one place where C++ exceptions stop and become statuses (C++ adapters only).
 *
 *     extern "C" ktg_status ktg_x(ktg_context *context, ...) noexcept {
 *         return ktg_guard(context, "x", [&]() -> ktg_status { ... return KTG_OK; });
 *     }
 */
#ifndef KTG_CORE_GUARD_HPP
#define KTG_CORE_GUARD_HPP

#include "core/core.h"

#include <exception>
#include <new>

template <typename Body>
ktg_status ktg_guard(ktg_context *context, const char *what, Body body) noexcept {
    try {
        return body();
    } catch (const std::bad_alloc &) {
        return ktg_fail(context, KTG_MEMORY, "out of memory (%s)", what);
    } catch (const std::exception &error) {
        return ktg_fail(context, KTG_INTERNAL, "%s: %s", what, error.what());
    } catch (...) {
        return ktg_fail(context, KTG_INTERNAL, "%s: unknown exception", what);
    }
}

#endif
