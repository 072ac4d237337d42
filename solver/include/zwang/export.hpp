/// ZWANG_EXPORT: the visible symbols of a shared library of zwang. The macro stands at every class and
/// function of a public header that is defined in a source file. Everything else is hidden, so that two
/// versions in one process do not meet.
#pragma once

#if defined(__GNUC__)
#define ZWANG_EXPORT __attribute__((visibility("default")))
#else
#define ZWANG_EXPORT
#endif
