/// Counts heap calls of this thread between `start` and `stop`, in the place of malloc. So Eigen's own
/// allocations count too, which a replaced operator new would not see. Not available under sanitizers, which
/// own malloc themselves.
#pragma once

namespace zwang::test {

bool can_count_heap_calls();
void start_counting_heap_calls();
long stop_counting_heap_calls();

}  // namespace zwang::test
