// Reads YAML files and robot descriptions with the libraries alone: the work that `zwang validate` cannot
// leave out.
#include <urdf_parser/urdf_parser.h>
#include <yaml-cpp/yaml.h>

#include <fstream>
#include <iterator>
#include <string>

namespace {

bool reads(const std::string& path) {
  if (!path.ends_with(".urdf")) return !YAML::LoadFile(path).IsNull();
  std::ifstream file(path);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  return urdf::parseURDF(text) != nullptr;
}

}  // namespace

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    if (!reads(argv[i])) return 1;
  }
  return argc > 1 ? 0 : 1;
}
