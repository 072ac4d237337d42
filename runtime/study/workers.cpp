#include "study/workers.hpp"

#include <poll.h>

#include <algorithm>
#include <memory>

#include "study/worker.hpp"

namespace zwang::study {

namespace {

constexpr int look_every = 100;  // [ms]

}  // namespace

void run_all(const std::vector<std::size_t>& cells, const WorkSettings& settings, const WorkCalls& calls) {
  std::vector<std::unique_ptr<Worker>> workers;
  while (workers.size() < std::min(settings.processes, cells.size()))
    workers.push_back(std::make_unique<Worker>(calls));
  for (std::size_t next = 0, ended = 0; ended < cells.size() && !calls.wants_to_stop();) {
    std::vector<pollfd> waiting;
    for (const auto& worker : workers) {
      if (worker->is_free() && next < cells.size()) worker->ask(cells[next++]);
      if (!worker->is_free()) waiting.push_back({worker->answers(), POLLIN, 0});
    }
    ::poll(waiting.data(), waiting.size(), look_every);
    for (const auto& worker : workers) {
      const std::optional<CellRecord> record = worker->outcome(settings.cell_limit);
      if (!record) continue;
      calls.done(*record);
      ++ended;
    }
    calls.wait();
  }
}

}  // namespace zwang::study
