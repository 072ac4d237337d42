#include "study/workers.hpp"

#include <poll.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "study/worker.hpp"

namespace zwang::study {

namespace {

constexpr int look_every = 100;  // [ms]

}  // namespace

std::string too_long(double cell_limit) {
  return "took longer than " + std::to_string(std::lround(cell_limit)) + " s";
}

void run_all(const std::vector<std::size_t>& cells, const WorkSettings& settings, const WorkCalls& calls) {
  std::vector<std::unique_ptr<Worker>> workers;
  while (workers.size() < std::min(settings.processes, cells.size()))
    workers.push_back(std::make_unique<Worker>(calls));
  for (std::size_t next = 0, ended = 0; ended < cells.size() && !calls.wants_to_stop();) {
    std::vector<pollfd> waiting;
    std::vector<Worker*> asked;
    for (const auto& worker : workers) {
      if (worker->is_free() && next < cells.size()) worker->ask(cells[next++]);
      if (worker->is_free()) continue;
      waiting.push_back({worker->answers(), POLLIN, 0});
      asked.push_back(worker.get());
    }
    ::poll(waiting.data(), waiting.size(), look_every);
    for (std::size_t i = 0; i < asked.size(); ++i) {
      if (waiting[i].revents != 0) {
        calls.done(asked[i]->answer());
        ++ended;
      } else if (asked[i]->busy_for() > settings.cell_limit) {
        calls.done(asked[i]->give_up(too_long(settings.cell_limit)));
        ++ended;
      }
    }
    calls.wait();
  }
}

}  // namespace zwang::study
