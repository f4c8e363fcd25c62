#!/bin/sh
# Every patch fits the code as it is.
cd "$(dirname "$0")/../.."
missed=0
for patch in tests/mutants/*.patch; do
  git apply --check "$patch" || missed=1
done
exit $missed
