/// Quantities outside of files: what a command line gives.
#pragma once

#include <optional>
#include <string_view>

#include "zwang/export.hpp"

namespace zwang::lang {

/// `0.5 m`, `30 cm`: [m]. nullopt when the text is anything but one length.
ZWANG_EXPORT std::optional<double> read_length(std::string_view text);
/// `20 deg`, `0.3 rad`: [rad]. nullopt when the text is anything but one angle.
ZWANG_EXPORT std::optional<double> read_angle(std::string_view text);
/// `46 kg`: [kg]. nullopt when the text is anything but one mass.
ZWANG_EXPORT std::optional<double> read_mass(std::string_view text);

}  // namespace zwang::lang
