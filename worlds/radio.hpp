// How robots of a team exchange what they know.
#pragma once

namespace worlds {

/// Each packet is broadcast to all robots in range, and comes or is lost for each of them by itself.
struct Radio {
  double range = 30.0;   // [m]; 0: nobody hears anybody
  double loss = 0.0;     // [-] probability that a packet is lost
  double cut_off = 0.0;  // [-] probability that only the begin of a packet comes
  double delay = 0.05;   // [s]
  double rate = 50'000;  // [byte/s] that one robot sends at most
  friend bool operator==(const Radio&, const Radio&) = default;
};

}  // namespace worlds
