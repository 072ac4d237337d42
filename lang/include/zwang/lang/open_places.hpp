/// The places of a drafted robot file that its owner has to fill in.
#pragma once

#include <string>
#include <vector>

#include "zwang/export.hpp"

namespace zwang::lang {

struct OpenPlace {
  int line = 0;         ///< from 1
  std::string entry;    ///< as it is written, without its comment
  std::string what_to;  ///< what to fill in, or why to check it
};

struct OpenPlaces {
  std::vector<OpenPlace> to_fill_in;  ///< they hold `FILL_IN`
  std::vector<OpenPlace> to_check;    ///< proposed
};

/// In the order of the file. Reads lines, for a file that is still open has no other shape.
ZWANG_EXPORT OpenPlaces open_places(const std::string& robot_file);

}  // namespace zwang::lang
