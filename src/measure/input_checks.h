#pragma once

#include <cstddef>
#include <new>

#include "core/sentence.h"
#include "probegi/image.h"

namespace probegi {

/// Errors: invalidArgument where the picture is empty or a value is not finite. `which`: "test", "reference" ...
Result<void> checkPicture(const HdrImage& image, const char* which);

/// Errors: invalidArgument where the pictures are not of one size.
Result<void> checkSameSize(const HdrImage& a, const HdrImage& b);

/// Errors: invalidArgument where the exposure is not above 0.
Result<void> checkExposure(float exposure);

/// Errors: invalidArgument where there are not equally many values.
Result<void> checkSameCount(const char* what, std::size_t count, std::size_t expected);

/// What `work` returns; where memory ends, an error that says what for.
template <class Work>
auto withinMemory(const char* purpose, const Work& work) -> decltype(work()) {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::outOfMemory, sentence("There is not enough memory to ", purpose, "."));
    }
}

}  // namespace probegi
