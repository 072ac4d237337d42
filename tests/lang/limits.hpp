/// The limits of text, and files that are exactly as large as they allow, or one larger.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace zwang::lang::test {

/// Files by their path below a folder.
using Files = std::map<std::string, std::string>;

struct Limit {
  std::string name;           ///< of the golden text: CODE_what or robot_CODE_what
  std::string code;           ///< said one past the limit
  int most = 0;               ///< as the documentation says it
  bool is_meaningful = true;  ///< a file at the limit can be a good one
  /// NAME.yaml and what it refers to, with `size` of what is limited.
  std::function<Files(const std::string& name, int size)> make;
};

std::vector<Limit> limits();

}  // namespace zwang::lang::test
