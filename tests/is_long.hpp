/// Whether `./dev test --long` asks for the full length.
#pragma once

#include <cstdlib>

namespace zwang::test {

inline bool is_long() {
  return std::getenv("ZWANG_LONG") != nullptr;
}

}  // namespace zwang::test
