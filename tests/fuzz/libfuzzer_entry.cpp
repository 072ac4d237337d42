// One target as a libFuzzer program; which one says the build.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  zwang::fuzz::ZWANG_FUZZ_TARGET({reinterpret_cast<const char*>(data), size});
  return 0;
}
