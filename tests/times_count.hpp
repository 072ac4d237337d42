/// Whether the time that a test takes says something: in an optimised program, without a sanitizer.
#pragma once

namespace zwang::test {

#if defined(NDEBUG) && !defined(ZWANG_SANITIZED)
inline constexpr bool times_count = true;
#else
inline constexpr bool times_count = false;
#endif

}  // namespace zwang::test
