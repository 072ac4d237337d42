#include "malloc_counter.hpp"

#include <cstddef>

#ifdef ZWANG_SANITIZED  // a sanitizer brings a malloc of its own
#define ZWANG_OWN_MALLOC 0
#else
#define ZWANG_OWN_MALLOC 1
#endif

namespace {
thread_local bool counting = false;
thread_local long calls = 0;
}  // namespace

#if ZWANG_OWN_MALLOC
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* block);

void* malloc(std::size_t size) {
  calls += counting ? 1 : 0;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  calls += counting ? 1 : 0;
  return __libc_calloc(count, size);
}
void* realloc(void* block, std::size_t size) {
  calls += counting ? 1 : 0;
  return __libc_realloc(block, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  calls += counting ? 1 : 0;
  return __libc_memalign(alignment, size);
}
void free(void* block) {
  calls += counting && block != nullptr ? 1 : 0;
  __libc_free(block);
}
}
#endif

namespace zwang::test {

bool can_count_heap_calls() {
  return ZWANG_OWN_MALLOC == 1;
}

void start_counting_heap_calls() {
  calls = 0;
  counting = true;
}

long stop_counting_heap_calls() {
  counting = false;
  return calls;
}

}  // namespace zwang::test
