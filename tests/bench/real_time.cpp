#include "real_time.hpp"

#include <malloc.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <time.h>

#include <chrono>
#include <functional>
#include <thread>

#include "../solver/malloc_counter.hpp"
#include "zwang/runtime/runner.hpp"

namespace zwang::bench {

namespace {

using Clock = std::chrono::steady_clock;

constexpr long nanoseconds_a_tick = 1'000'000;
constexpr std::size_t warm_up = 1000;  // ticks: the first second
constexpr int priority = 40;
constexpr int smallest_list = 4096;  // [bytes] a page

long page_faults() {
  rusage usage{};
  ::getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_minflt + usage.ru_majflt;
}

double microseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::micro>(Clock::now() - start).count();
}

/// About 6 us of dependent arithmetic: it touches no memory, so that only the machine can delay it.
double probe() {
  const auto start = Clock::now();
  volatile double sum = 1.0;
  for (int i = 0; i < 1500; ++i) sum = sum * 0.999 + 1.0;
  return microseconds_since(start);
}

void sleep_until_next(timespec& next) {
  next.tv_nsec += nanoseconds_a_tick;
  if (next.tv_nsec >= 1'000'000'000) {
    next.tv_nsec -= 1'000'000'000;
    ++next.tv_sec;
  }
  ::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &next, nullptr);
}

void loop(const std::vector<runtime::Sensed>& samples, runtime::Runner& runner, RealTimeRun& run) {
  const sched_param parameters{priority};
  run.has_priority = ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &parameters) == 0;
  timespec next{};
  ::clock_gettime(CLOCK_MONOTONIC, &next);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    sleep_until_next(next);
    const long faults = page_faults();
    test::start_counting_heap_calls();
    const auto start = Clock::now();
    runner.step(samples[i]);
    const double time = microseconds_since(start);
    const long heap_calls = test::stop_counting_heap_calls();
    const long new_faults = page_faults() - faults;
    const double probed = probe();
    if (i < warm_up) continue;
    run.steps.push_back(time);
    run.probes.push_back(probed);
    run.heap_calls += heap_calls;
    run.page_faults += new_faults;
  }
}

}  // namespace

RealTimeRun run_in_real_time(const lang::Program& program, const std::vector<runtime::Sensed>& samples) {
  RealTimeRun run;
  run.steps.reserve(samples.size());
  run.probes.reserve(samples.size());
  // The runner's lists come from fresh pages: in used ones a fault would not show.
  ::mallopt(M_MMAP_THRESHOLD, smallest_list);
  runtime::Runner runner(program, {.period = 1e-3});
  // Touched pages stay mapped. The call does not map untouched pages, so that their page faults show.
  run.has_locked_pages = ::mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) == 0;
  std::thread(loop, std::cref(samples), std::ref(runner), std::ref(run)).join();
  if (run.has_locked_pages) ::munlockall();
  return run;
}

}  // namespace zwang::bench
