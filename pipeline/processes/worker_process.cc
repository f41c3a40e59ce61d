#include "pipeline/processes/worker_process.h"

#include <spawn.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <new>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "pipeline/processes/exit_code.h"

namespace blocklift::pipeline {
namespace {

// Both directions: what a worker would read from a terminal comes from here.
constexpr int end_of_worker = STDIN_FILENO;

/// The environment without what a launcher has told this process about its group.
std::vector<char*> environment_of_one() {
  std::vector<char*> variables;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view text = *variable;
    if (text.starts_with("OMPI_") || text.starts_with("PMI_") || text.starts_with("PMIX_"))
      continue;
    variables.push_back(*variable);
  }
  variables.push_back(nullptr);
  return variables;
}

/// Starts this program again.
/// @param input that becomes its standard input; -1: that of this process.
pid_t start_this_program(std::vector<std::string> arguments, int input) {
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  if (input >= 0) ::posix_spawn_file_actions_adddup2(&actions, input, end_of_worker);
  pid_t process = 0;
  const int error = ::posix_spawn(&process, "/proc/self/exe", &actions, nullptr, pointers.data(),
                                  environment_of_one().data());
  ::posix_spawn_file_actions_destroy(&actions);
  if (error != 0)
    throw std::runtime_error("a worker cannot be started: " +
                             std::generic_category().message(error));
  return process;
}

/// Sends all of a text; false if nobody is there to read it.
bool send_all(int socket, std::string_view text) {
  while (!text.empty()) {
    const ssize_t sent = ::send(socket, text.data(), text.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

std::string line_of(const WorkOrder& order) {
  return fmt::format("{} {} {}\n", order.kind == WorkOrder::Kind::member ? "member" : "blocks",
                     order.number, order.of);
}

/// Waits for the next order; nothing: there are no more.
std::optional<WorkOrder> next_order() {
  std::string line;
  for (char letter = 0; letter != '\n';) {
    const ssize_t count = ::read(end_of_worker, &letter, 1);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return std::nullopt;
    line += letter;
  }
  std::istringstream stream(line);
  std::string kind;
  WorkOrder order;
  stream >> kind >> order.number >> order.of;
  if (!stream) return std::nullopt;
  order.kind = kind == "member" ? WorkOrder::Kind::member : WorkOrder::Kind::blocks;
  return order;
}

}  // namespace

WorkerProcess::WorkerProcess(std::vector<std::string> arguments)
    : arguments_(std::move(arguments)) {}

WorkerProcess::WorkerProcess(WorkerProcess&& other) noexcept
    : arguments_(std::move(other.arguments_)),
      process_(std::exchange(other.process_, -1)),
      socket_(std::exchange(other.socket_, -1)),
      order_(std::exchange(other.order_, std::nullopt)),
      received_(std::move(other.received_)) {}

WorkerProcess::~WorkerProcess() { end(); }

void WorkerProcess::start() {
  std::array<int, 2> sockets{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets.data()) != 0)
    throw std::runtime_error("a worker cannot be started: " +
                             std::generic_category().message(errno));
  socket_ = sockets[0];
  try {
    process_ = start_this_program(arguments_, sockets[1]);
  } catch (...) {
    ::close(sockets[1]);
    end();
    throw;
  }
  ::close(sockets[1]);
}

void WorkerProcess::end() {
  if (socket_ >= 0) ::close(std::exchange(socket_, -1));
  received_.clear();
  order_.reset();
  if (process_ < 0) return;
  ::kill(process_, SIGKILL);
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
}

void WorkerProcess::give(const WorkOrder& order) {
  if (process_ < 0) start();
  // A worker that is gone by now is found lost when its answer is due.
  send_all(socket_, line_of(order));
  order_ = order;
}

std::optional<WorkAnswer> WorkerProcess::take_answer() {
  if (!order_) return std::nullopt;
  std::array<char, 1 << 16> buffer;
  for (;;) {
    const ssize_t count = ::recv(socket_, buffer.data(), buffer.size(), MSG_DONTWAIT);
    if (count > 0) {
      received_.append(buffer.data(), static_cast<std::size_t>(count));
      continue;
    }
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) break;
    end();
    return WorkAnswer{};
  }
  // "d 1234" and a line's end before 1234 bytes.
  const std::size_t head = received_.find('\n');
  if (head == std::string::npos) return std::nullopt;
  const std::size_t size = std::strtoull(received_.c_str() + 2, nullptr, 10);
  if (received_.size() < head + 1 + size) return std::nullopt;
  WorkAnswer answer{static_cast<WorkAnswer::Kind>(received_.front()),
                    received_.substr(head + 1, size)};
  received_.erase(0, head + 1 + size);
  const bool is_over = order_->kind == WorkOrder::Kind::blocks;
  order_.reset();
  if (is_over) end();
  return answer;
}

void answer_orders(const std::function<std::string(const WorkOrder&)>& compute) {
  // What nobody asks for any more is not finished.
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  while (const std::optional<WorkOrder> order = next_order()) {
    WorkAnswer answer;
    try {
      answer = {WorkAnswer::Kind::done, compute(*order)};
    } catch (const std::invalid_argument& error) {
      answer = {WorkAnswer::Kind::refused, error.what()};
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      answer = {WorkAnswer::Kind::failed, error.what()};
    }
    if (!send_all(end_of_worker, fmt::format("{} {}\n{}", static_cast<char>(answer.kind),
                                             answer.text.size(), answer.text)))
      return;
  }
}

bool run_this_program(std::vector<std::string> arguments, const std::function<void()>& meanwhile) {
  const pid_t process = start_this_program(std::move(arguments), -1);
  for (;;) {
    int status = 0;
    const pid_t ended = ::waitpid(process, &status, WNOHANG);
    if (ended == process) return WIFEXITED(status) && WEXITSTATUS(status) == exit_code::done;
    if (ended < 0 && errno != EINTR) return false;
    meanwhile();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

}  // namespace blocklift::pipeline
