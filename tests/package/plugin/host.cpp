#include <dlfcn.h>

#include <cstdio>

// host PLUGIN TASK.yaml
int main(int count, char** arguments) {
  if (count != 3) return 2;
  void* plugin = dlopen(arguments[1], RTLD_NOW | RTLD_LOCAL);
  if (plugin == nullptr) {
    std::printf("%s\n", dlerror());
    return 1;
  }
  using Function = double (*)(const char*);
  const Function torque = reinterpret_cast<Function>(dlsym(plugin, "largest_torque_of_ten_ticks"));
  const double largest = torque == nullptr ? -1.0 : torque(arguments[2]);
  std::printf("%.3f N m\n", largest);
  return largest > 0.0 ? 0 : 1;
}
