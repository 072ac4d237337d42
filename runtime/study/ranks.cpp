#include "study/ranks.hpp"

#include <dlfcn.h>
#include <poll.h>

#include <cstdlib>
#include <stdexcept>

#include "study/worker.hpp"

namespace zwang::study {

namespace {

namespace fs = std::filesystem;

const char* const no_more = "no more";
const char* const no_study = "no study";  // in the place of its identity
/// While cells run there is no hurry: they take a tenth of a second and more.
constexpr double busy_look = 5e-4, idle_look = 0.1;  // [s]

/// Whether a starter of parallel jobs made this process: Open MPI's mpirun, or one that speaks PMI or PMIx.
bool is_in_a_job() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"}) {
    if (std::getenv(name) != nullptr) return true;
  }
  return false;
}

}  // namespace

std::unique_ptr<Messages> messages_of_job(const std::optional<fs::path>& library) {
  if (!is_in_a_job()) return nullptr;
  if (!library)
    throw std::runtime_error(
        "this zwang was built without MPI: install libopenmpi-dev and build again, or run parts of the study "
        "by --shard");
  // Open MPI's own parts look for its names among those of all libraries.
  void* loaded = ::dlopen(library->c_str(), RTLD_NOW | RTLD_GLOBAL);
  if (loaded == nullptr) throw std::runtime_error(::dlerror());
  using Join = Messages* (*)();
  const auto join = reinterpret_cast<Join>(::dlsym(loaded, "zwang_join_job"));
  if (join == nullptr) throw std::runtime_error(::dlerror());
  return std::unique_ptr<Messages>(join());
}

void run_with_ranks(const std::vector<std::size_t>& cells, const WorkSettings& settings,
                    const WorkCalls& calls, const std::string& identity, Messages& messages) {
  std::vector<std::unique_ptr<Worker>> workers;
  while (workers.size() < settings.processes) workers.push_back(std::make_unique<Worker>(calls));
  std::vector<bool> is_known(static_cast<std::size_t>(messages.size()), false);
  int listening = messages.size() - 1;  // ranks that have not been told that there are no more
  std::size_t next = 0, ended = 0;
  const auto keep = [&](const CellRecord& record) {
    calls.done(record);
    ++ended;
  };
  const auto take = [&](const Messages::Message& message) {
    const auto from = static_cast<std::size_t>(message.from);
    if (is_known[from]) {
      keep(record_of(message.text));
    } else if (message.text != identity) {
      throw std::runtime_error("rank " + std::to_string(message.from) +
                               " has read another study, or is another version of zwang");
    }
    is_known[from] = true;
    const bool is_more = next < cells.size() && !calls.wants_to_stop();
    messages.send(message.from, is_more ? std::to_string(cells[next]) : no_more);
    if (is_more) {
      ++next;
    } else {
      --listening;
    }
  };
  while (listening > 0 || (ended < cells.size() && !calls.wants_to_stop())) {
    for (const auto& worker : workers) {
      if (worker->is_free() && next < cells.size() && !calls.wants_to_stop()) worker->ask(cells[next++]);
      if (const auto record = worker->outcome(settings.cell_limit)) keep(*record);
    }
    for (auto message = messages.receive(busy_look); message; message = messages.receive(0.0)) take(*message);
    calls.wait();
  }
}

void end_without_study(Messages& messages) {
  if (messages.rank() > 0) {
    messages.send(0, no_study);
    while (!messages.receive(idle_look)) {
    }
    return;
  }
  for (int listening = messages.size() - 1; listening > 0;) {
    const auto message = messages.receive(idle_look);
    if (!message) continue;
    messages.send(message->from, no_more);
    --listening;
  }
}

void serve_rank(const WorkSettings& settings, const WorkCalls& calls, const std::string& identity,
                Messages& messages) {
  Worker worker(calls);
  messages.send(0, identity);
  for (;;) {
    const auto message = messages.receive(idle_look);
    if (!message) continue;
    if (message->text == no_more) return;
    worker.ask(std::stoull(message->text));
    std::optional<CellRecord> record;
    while (!(record = worker.outcome(settings.cell_limit))) {
      pollfd file{worker.answers(), POLLIN, 0};
      ::poll(&file, 1, static_cast<int>(1e3 * idle_look));
    }
    messages.send(0, to_text(*record));
  }
}

}  // namespace zwang::study
