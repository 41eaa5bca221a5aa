#pragma once

#include <probegi/result.h>

/// What Result::value() does for results with a value: throws where the call has failed. An engine without exceptions
/// looks at the Result instead.
inline void must(const probegi::Result<void>& done) {
    if (!done) throw tl::bad_expected_access<probegi::Error>(done.error());
}
