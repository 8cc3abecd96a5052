#pragma once

#include "netsim/proxy/app/control_socket.h"
#include "netsim/proxy/app/proxy.h"
#include "netsim/proxy/app/proxy_control.h"

namespace tandem::netsim {

/// Runs the console of a running proxy: shows the live view and executes commands from keyboard and control socket. A
/// terminal shows the view in place; other outputs get one plain line every five seconds. Returns after a signal, the
/// end of the proxy, or a stop command.
/// @param signals   readable after a signal
/// @param finished  readable when the proxy has ended
void run_control_loop(Proxy& proxy, ProxyControl& control, ControlSocket& socket, int signals, int finished);

/// Returns the text of an answer for the control socket; its first character encodes the result.
[[nodiscard]] std::string control_reply_text(const ProxyControl::Answer& answer);

}  // namespace tandem::netsim
