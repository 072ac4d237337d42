// The baseline of the validation benchmark: the same libraries are linked, and yaml-cpp reads the file.
#include <yaml-cpp/yaml.h>

int main(int argc, char** argv) {
  return argc == 2 && YAML::LoadFile(argv[1]).IsMap() ? 0 : 1;
}
