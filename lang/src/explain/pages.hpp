/// The pages of docs/errors, which the build puts into the library (pages.cmake).
#pragma once

#include <span>
#include <string_view>

namespace zwang::lang::catalogue {

/// Each as its file has it.
std::span<const std::string_view> pages();

}  // namespace zwang::lang::catalogue
