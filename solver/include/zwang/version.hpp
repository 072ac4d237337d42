/// The version of zwang, of all its rooms. Before 1.0 another minor version may have other interfaces.
/// CMakeLists.txt, the packages and `zwang --version` read it here.
#pragma once

#define ZWANG_VERSION_MAJOR 0
#define ZWANG_VERSION_MINOR 1
#define ZWANG_VERSION_PATCH 0
#define ZWANG_VERSION "0.1.0"
