/// The files of two runs, side by side.
#pragma once

#include <string>
#include <vector>

#include "zwang/lang/source.hpp"

namespace zwang::cli {

/// A file of the first run and its counterpart in the second.
struct FilePair {
  std::string first, second;  ///< paths; empty: only the other run has it
  bool is_same = false;
  int line = 0;                                        ///< the first one that differs
  std::vector<std::string> first_lines, second_lines;  ///< from there to the last that differs
};

/// A file's counterpart has its path; else its name; else both are the task files, which come first.
std::vector<FilePair> pairs_of(const std::vector<lang::Source>& first,
                               const std::vector<lang::Source>& second);

}  // namespace zwang::cli
