#include "common/io/datagram_steering.h"

#include <sys/socket.h>

#include <algorithm>
#include <limits>
#include <span>
#include <tuple>

namespace tandem::io {
namespace {

/// Appends the search for values `first` ... `first + sockets.size() - 1`.
void append_search(std::vector<sock_filter>& program, std::size_t first, std::span<const std::uint8_t> sockets) {
  if (std::ranges::all_of(sockets, [&](std::uint8_t s) { return s == sockets.front(); })) {
    program.push_back({BPF_RET | BPF_K, 0, 0, sockets.front()});
    return;
  }
  const std::size_t half = sockets.size() / 2, branch = program.size();
  program.push_back({BPF_JMP | BPF_JGE | BPF_K, 0, 0, static_cast<std::uint32_t>(first + half)});
  append_search(program, first, sockets.first(half));
  // Half of the values takes at most 2 * 128 - 1 instructions, which a jump of 8 bits can skip.
  program[branch].jt = static_cast<std::uint8_t>(program.size() - branch - 1);
  append_search(program, first + half, sockets.subspan(half));
}
static_assert(std::tuple_size_v<decltype(Steering::socket_of)> - 1 == std::numeric_limits<std::uint8_t>::max());

}  // namespace

SteeringProgram::SteeringProgram(const Steering& steering)
    : program_{{BPF_LD | BPF_B | BPF_ABS, 0, 0, static_cast<std::uint32_t>(steering.byte)}} {
  append_search(program_, 0, steering.socket_of);
}

bool SteeringProgram::attach(int fd) const noexcept {
  const sock_fprog filter{static_cast<unsigned short>(program_.size()), const_cast<sock_filter*>(program_.data())};
  return ::setsockopt(fd, SOL_SOCKET, SO_ATTACH_REUSEPORT_CBPF, &filter, sizeof filter) == 0;
}

}  // namespace tandem::io
