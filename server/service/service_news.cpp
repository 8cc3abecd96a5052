#include "server/service/service_news.h"

#include <utility>

#include "common/base/format.h"

namespace tandem::server {

std::string directory_remedy(const std::string& endpoints, const std::string& tls_options) {
  std::string addresses = endpoints;  // as etcdctl takes them
  std::erase(addresses, ' ');
  return "Check that etcd runs there (`etcdctl --endpoints " + addresses + tls_options +
         " endpoint health`), and directory { endpoint } in the configuration. " +
         (!tls_options.empty() ? "With TLS, etcd must accept directory { certificate } by its --trusted-ca-file, and "
                                 "directory { authority } must have signed the certificate of etcd for this address: "
                                 "`openssl verify -CAfile AUTHORITY CERTIFICATE` checks each. etcd's certificate "
                                 "needs the address as subjectAltName, or directory { name_in_certificate }"
                               : "An etcd that demands TLS needs directory { authority, certificate, private_key }");
}

std::vector<ServiceNews::Line> ServiceNews::update(Time now, const ServiceStatus& status) {
  std::vector<Line> lines;
  if (!began_) began_ = now;
  if (!status.name_taken)
    name_taken_since_.reset();
  else if (!name_taken_since_)
    name_taken_since_ = now;
  // A server that has ended a moment ago stays registered until its lease ends.
  const bool name_taken = name_taken_since_ && now - *name_taken_since_ > times_.ttl + std::chrono::seconds(1);
  const bool was_member = state_ == State::kMember || state_ == State::kNoAnswer;
  const Duration limit = 2 * times_.answer_limit;
  State next = state_;
  if (name_taken) {
    next = State::kNameTaken;
  } else if (status.registered && status.answers) {
    next = State::kMember;
  } else if (!status.answers && was_member) {
    next = State::kNoAnswer;
  } else if (!status.answers && now - *began_ > limit) {
    next = State::kUnreachable;
  }
  const std::string cause = status.trouble.empty() ? "no answer in time" : status.trouble;
  const State before = std::exchange(state_, next);
  if (next != before) {
    if (next == State::kMember)
      lines.push_back({false, "service_joined",
                       before == State::kNoAnswer ? "the directory of the service answers again"
                                                  : format("%s is a member of the service, with a lease of %g s",
                                                           server_.c_str(), seconds(times_.ttl))});
    if (next == State::kNoAnswer)
      lines.push_back({true, "service_no_answer",
                       "the directory of the service at " + endpoints_ + " does not answer: " + cause +
                           format("; sessions are HELD %g s after the last renewal, until it answers",
                                  seconds(times_.hold_after))});
    if (next == State::kUnreachable)
      lines.push_back({true, "service_unreachable",
                       "the directory of the service at " + endpoints_ + " cannot be reached: " + cause +
                           "; this server serves no session until it answers, and goes on trying. " +
                           directory_remedy(endpoints_, tls_options_)});
    if (next == State::kNameTaken)
      lines.push_back({true, "service_name_taken",
                       "another server is registered in the service as " + server_ +
                           "; end it, or give this server a member file with another name (`tandem-server service "
                           "vouch --name NAME`, then `tandem-server service join`). This server goes on trying"});
  }
  if (status.stranger && !std::exchange(stranger_, true))
    lines.push_back({false, "service_first_start",
                     format("this server has not been in this service before: it begins sessions in %g s, when all "
                            "leases of a directory that may have been lost a moment ago are over",
                            seconds(times_.ttl))});
  if (status.losses != std::exchange(losses_, status.losses))
    lines.push_back(
        {true, "service_directory_lost",
         "the directory of the service at " + endpoints_ +
             " has lost its data: it was begun from nothing, or put back to an older state. This server writes its "
             "workstations there again" +
             format(", and serves its sessions again when the leases of before are over, in %g s, from their last "
                    "state. Sessions that an operator created at a server which does not run are gone, and a ticket "
                    "that was used may be accepted once more. If etcd has its data elsewhere, check its --data-dir; "
                    "if there is a backup, end all servers and restore it; if you have just restored one, do nothing",
                    seconds(times_.ttl))});
  if (!status.recovers && std::exchange(recovers_, status.recovers))
    lines.push_back({false, "service_recovered",
                     format("the service goes on in the directory as it is now: %zu session%s known here",
                            status.sessions, status.sessions == 1 ? " is" : "s are")});
  recovers_ = status.recovers;
  const bool held = status.held();
  if (held != std::exchange(held_, held))
    lines.push_back(
        held ? Line{true, "service_held",
                    format("%zu session%s HELD: the lease of this server was not renewed in time, so no hand is "
                           "engaged until the directory answers; screens show BRAKED with this reason",
                           status.owned, status.owned == 1 ? "" : "s")}
             : Line{false, "service_goes_on", "the sessions are not HELD by the directory any more"});
  return lines;
}

}  // namespace tandem::server
