#include "tools/common/memory.h"

#include <malloc.h>

namespace copse {

void return_large_arrays() {
  mallopt(M_MMAP_THRESHOLD, 12 << 20);
  mallopt(M_TRIM_THRESHOLD, 8 << 20);
}

}  // namespace copse
