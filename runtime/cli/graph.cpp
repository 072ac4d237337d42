// The tasks of a file as a graph, for Graphviz or Mermaid.
#include "graph.hpp"

#include <sstream>
#include <vector>

#include "file_kind.hpp"
#include "output.hpp"
#include "verbs.hpp"
#include "zwang/lang/printable.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::cli {

namespace {

using lang::Program;

std::string name_of(const Program& program, const lang::Target& target) {
  switch (target.kind) {
    case lang::TargetKind::task:
      return "task " + program.tasks[static_cast<std::size_t>(target.task)].name;
    case lang::TargetKind::back:
      return back_node;
    case lang::TargetKind::done:
      return "done";
    case lang::TargetKind::failed:
      break;
  }
  return "failed";
}

std::string seconds(const Program& program, const lang::Value& value) {
  if (value.parameter >= 0) return "$" + program.parameters[static_cast<std::size_t>(value.parameter)].name;
  std::ostringstream text;
  text << value.constant << " s";
  return text.str();
}

std::string label_of(const Program& program, const lang::Exit& exit) {
  std::string label = lang::in_one_line(exit.when.text);
  if (exit.dwell.parameter >= 0 || exit.dwell.constant > 0.0) {
    label += " for " + seconds(program, exit.dwell);
  }
  return label;
}

}  // namespace

Graph graph_of(const Program& program) {
  Graph graph;
  graph.start = "task " + program.tasks[static_cast<std::size_t>(program.start)].name;
  graph.has_always = !program.always.exits.empty();
  for (const lang::Exit& exit : program.always.exits) {
    graph.edges.push_back({always_node, name_of(program, exit.target), label_of(program, exit), true});
  }
  for (const lang::Task& task : program.tasks) {
    const std::string name = "task " + task.name;
    graph.tasks.push_back(name);
    if (task.require) {
      graph.edges.push_back(
          {name, "failed", "not (" + lang::in_one_line(task.require->text) + ") on entry", true});
    }
    if (task.attempts) {
      const std::string count = std::to_string(task.attempts->most);
      graph.edges.push_back(
          {name, name_of(program, task.attempts->target), "more than " + count + " entries", true});
    }
    if (task.timeout) {
      graph.edges.push_back({name, name_of(program, task.timeout->target),
                             "timeout " + seconds(program, task.timeout->after), false});
    }
    for (const lang::Exit& exit : task.exits) {
      graph.edges.push_back({name, name_of(program, exit.target), label_of(program, exit), false});
    }
  }
  return graph;
}

namespace {

std::string shown_name(const std::string& node) {
  if (node == always_node) return "in any task";
  if (node == back_node) return "back to where it was";
  return node.starts_with("task ") ? node.substr(5) : node;
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

std::string dot(const Graph& graph) {
  std::string text = "digraph tasks {\n  node [shape=box, style=rounded];\n";
  const auto node = [&](const std::string& name, const std::string& look) {
    text += "  " + quoted(name) + " [label=" + quoted(shown_name(name)) + (look.empty() ? "" : ", " + look) +
            "];\n";
  };
  text += "  \"start\" [shape=point];\n";
  for (const std::string& task : graph.tasks) node(task, "");
  if (graph.has_always) node(always_node, "shape=plaintext");
  for (const char* end : {"done", "failed"}) {
    if (graph.leads_to(end)) node(end, "shape=doublecircle");
  }
  if (graph.leads_to(back_node)) node(back_node, "shape=plaintext");
  text += "  \"start\" -> " + quoted(graph.start) + ";\n";
  for (const Edge& edge : graph.edges) {
    text += "  " + quoted(edge.from) + " -> " + quoted(edge.to) + " [label=" + quoted(edge.label) +
            (edge.is_interruption ? ", style=dashed" : "") + "];\n";
  }
  return text + "}\n";
}

/// Mermaid has words of its own (`end`) and reads labels as HTML.
std::string mermaid_id(const std::string& node) {
  return node.starts_with("task ") ? "task_" + node.substr(5) : "_" + node;
}

std::string mermaid_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '"':
        result += "#quot;";
        break;
      case '<':
        result += "#lt;";
        break;
      case '>':
        result += "#gt;";
        break;
      case '&':
        result += "#amp;";
        break;
      case '#':
        result += "#35;";
        break;
      default:
        result += c;
    }
  }
  return "\"" + result + "\"";
}

std::string mermaid(const Graph& graph) {
  std::string text = "flowchart TD\n";
  const auto node = [&](const std::string& name, const char* open, const char* close) {
    text += "  " + mermaid_id(name) + open + mermaid_text(shown_name(name)) + close + "\n";
  };
  text += "  _start((\" \"))\n";
  for (const std::string& task : graph.tasks) node(task, "(", ")");
  if (graph.has_always) node(always_node, "[/", "/]");
  for (const char* end : {"done", "failed"}) {
    if (graph.leads_to(end)) node(end, "(((", ")))");
  }
  if (graph.leads_to(back_node)) node(back_node, "[/", "/]");
  text += "  _start --> " + mermaid_id(graph.start) + "\n";
  for (const Edge& edge : graph.edges) {
    text += "  " + mermaid_id(edge.from) + (edge.is_interruption ? " -.->|" : " -->|") +
            mermaid_text(edge.label) + "| " + mermaid_id(edge.to) + "\n";
  }
  return text;
}

}  // namespace

int graph(const GraphArguments& arguments) {
  require_file(arguments.file);
  refuse_urdf(arguments.file);
  lang::Diagnostics diagnostics;
  const std::optional<Program> program =
      lang::load(arguments.file, arguments.overrides.load_options(), diagnostics);
  if (!program) {
    print_error(rendered(diagnostics));
    return exit_bad;
  }
  const Graph graph = graph_of(*program);
  print_data(arguments.format == GraphFormat::dot ? dot(graph) : mermaid(graph));
  return exit_good;
}

}  // namespace zwang::cli
