#include "harness/stress/resident_memory.hpp"

#include <malloc.h>
#include <unistd.h>

#include <fstream>

namespace harness {

double resident_bytes() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
  std::ifstream file("/proc/self/statm");
  double total = 0.0;
  double resident = 0.0;
  if (!(file >> total >> resident)) return 0.0;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace harness
