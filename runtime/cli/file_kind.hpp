/// Which of zwang's files a file is, and reading it as that.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "zwang/lang/file_kind.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::cli {

using lang::FileKind;
using lang::kind_of_file;
using lang::word_of;

/// The YAML files below a folder, in the order of their names. Links are followed; a file that several names
/// lead to is there once, by the name without a link where it has one. Throws Impossible for a folder that
/// cannot be read.
std::vector<std::string> yaml_files_below(const std::string& folder);

/// Whether the first letter of a file is that of XML.
bool is_urdf(const std::string& path);
bool is_urdf_text(const std::string& text);
/// Throws Impossible, with the way out, where a URDF is given in the place of a file of zwang's.
void refuse_urdf(const std::string& path);
/// As what it is known to be.
[[noreturn]] void refuse_as_urdf(const std::string& path);

struct Reading {
  lang::LoadOptions options = {};     ///< of a task file
  bool with_notes = false;            ///< notes are looked for, too
  bool with_plant = false;            ///< the simulated plant of a task or robot file is asked, E915
  std::optional<std::string> task{};  ///< that a connection file is checked against
};
/// The content that was read, in a few words; nothing when it is bad.
std::optional<std::string> read_as(FileKind kind, const std::string& path, lang::Diagnostics& diagnostics,
                                   const Reading& reading = {});

}  // namespace zwang::cli
