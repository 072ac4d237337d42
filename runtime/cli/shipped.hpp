/// The files that come with zwang: tasks that can be run by their names.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>

namespace zwang::cli {

/// The first of these ways from the folder of this program that leads to something: where it was installed,
/// where it was built. nullopt: none does.
std::optional<std::filesystem::path> beside_program(std::initializer_list<const char*> ways);
/// A program or a library that only some parts of zwang need; nullopt: it was not built, or not installed.
std::optional<std::filesystem::path> optional_part(const std::string& name);

/// `specs` of the installation or of the checkout that the program was built in; nullopt when neither is
/// there.
std::optional<std::filesystem::path> shipped_folder();

/// `wall_align` is the shipped task of that name where no file is called so. In the folder `scenarios` of the
/// shipped files it is a scenario, in `robots` `kelo_base` is a robot. Anything else stays as it is. Throws
/// Impossible, with the name that was meant, when a bare name is neither.
std::string file_or_shipped(const std::string& file, const std::string& folder = ".");

}  // namespace zwang::cli
