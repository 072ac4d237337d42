/// The meanings of the words of the command line. Each function throws Impossible for a word that is not
/// allowed there.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "zwang/runtime/log_parts.hpp"

namespace zwang::cli {

double angle(const std::string& text);                                 ///< `20 deg` [rad]
std::array<double, 2> point(const std::string& text);                  ///< `0 m, 0.5 m` [m]
std::uint64_t seed(const std::string& text);                           ///< a whole number
runtime::LogRotation rotation(const std::vector<std::string>& texts);  ///< `500 MB`, `10 min`, or both
/// `push=30N` each: values as text, by name.
std::map<std::string, std::string> parameters(const std::vector<std::string>& texts);

}  // namespace zwang::cli
