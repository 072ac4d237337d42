/// The program in a folder with the shipped specs.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "program.hpp"

namespace zwang::test {

namespace fs = std::filesystem;
using nlohmann::json;

inline const fs::path shipped = fs::path(ZWANG_SOURCE_DIR) / "specs";

/// A folder with the shipped specs; arguments in one line, both streams in `out`.
class CliPlan : public test::Program {
 protected:
  void SetUp() override { fs::copy(shipped, folder_, fs::copy_options::recursive); }

  Result zwang(const std::string& line) {
    std::istringstream in(line);
    std::vector<std::string> arguments;
    for (std::string word; in >> word;) arguments.push_back(word);
    Result result = Program::zwang(arguments);
    result.out += result.err;
    return result;
  }
  json zwang_json(const std::string& arguments) {
    const Result result = zwang(arguments + " --format json");
    EXPECT_EQ(result.code, 0) << result.out;
    return json::parse(result.out);
  }
  /// The first row of the task with this name and kind.
  static json row(const json& task, const std::string& name, const std::string& kind) {
    for (const json& r : task.at("rows")) {
      if (r.at("row") == name && r.at("kind") == kind) return r;
    }
    ADD_FAILURE() << "no row " << name << " " << kind << " in " << task.dump(1);
    return {};
  }
};

}  // namespace zwang::test
