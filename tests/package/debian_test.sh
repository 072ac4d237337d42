#!/usr/bin/env bash
# debian_test.sh SOURCE BINARY: the packages of `./dev package` as users meet them. They are installed into a fresh Debian 12
# root. Then a task runs there, the module is imported, and a program is built against the libraries.
# Skipped unless ZWANG_LONG is set, it runs as root, and debootstrap and the packages are there.
set -euo pipefail
source=$1 packages=$2/packages
skip() { echo "skipped: $1"; exit 77; }
[[ ${ZWANG_LONG-} ]] || skip 'only with ZWANG_LONG'
((EUID == 0)) || skip 'only root may make a root folder'
command -v debootstrap >/dev/null || skip 'apt install debootstrap'
compgen -G "$packages/*.deb" >/dev/null || skip 'run ./dev package first'

place=$(mktemp -d)
root=$place/root
trap 'umount "$root/proc" 2>/dev/null || true; rm -rf --one-file-system "$place"' EXIT

step() {
  local name=$1
  shift
  "$@" >"$place/log" 2>&1 && return
  printf 'FAIL: %s\n' "$name"
  tail -n 40 "$place/log"
  exit 1
}
# The tools of the machine that builds are none of the root's.
inside() { chroot "$root" env -u CMAKE_CXX_COMPILER_LAUNCHER -u CXX DEBIAN_FRONTEND=noninteractive HOME=/root sh -ec "cd /root; $1"; }

if command -v lintian >/dev/null; then step 'lintian' lintian --allow-root --fail-on error,warning "$packages"/*.deb; fi
step 'a fresh root' debootstrap --variant=minbase bookworm "$root"
mount -t proc proc "$root/proc"
cp /etc/apt/sources.list.d/* "$root/etc/apt/sources.list.d/" 2>/dev/null || true
cp /etc/resolv.conf "$root/etc/" 2>/dev/null || true
mkdir "$root/packages"
cp "$packages"/*.deb "$root/packages/"
cp -r "$source/examples" "$root/root/examples"
step 'the list of packages' inside 'apt-get -qq update'

step 'zwang' inside 'apt-get -qq -y install --no-install-recommends /packages/zwang_*.deb'
step 'a shipped task by its name' inside 'zwang run wall_align'
step 'a folder of its own' inside 'zwang init mine; cd mine; zwang run wall_align.yaml; zwang test scenarios'
step 'a page' inside 'zwang run wall_align --log seen; zwang report seen -o page.html; test -s page.html'
step 'manual and completion' inside 'test -s /usr/share/man/man1/zwang.1.gz; zwang completion bash'

step 'python3-zwang' inside 'apt-get -qq -y install --no-install-recommends /packages/python3-zwang_*.deb'
step 'the module' inside "cd mine; python3 -c 'import zwang; assert zwang.run(zwang.load(\"wall_align.yaml\")).outcome == \"done\"'"

step 'zwang-ros2' inside 'apt-get -qq -y install --no-install-recommends /packages/zwang-ros2_*.deb'
step 'drive' inside 'zwang drive --help'

step 'zwang-mpi' inside 'apt-get -qq -y install --no-install-recommends /packages/zwang-mpi_*.deb openmpi-bin'
step 'a study on two ranks' inside 'cd mine; printf "zwang_study: 1\ntask: wall_align.yaml\nruns: 4\ndraw: {params.push: {uniform: [5 N, 40 N]}}\nexpect: [{outcome: done, probability: 30 %%}]\n" > study.yaml; mpirun --allow-run-as-root --oversubscribe -n 2 zwang sweep study.yaml --out study.db'

step 'libzwang-dev' inside 'apt-get -qq -y install --no-install-recommends /packages/libzwang-dev_*.deb g++ cmake ninja-build'
step 'a program of its own' inside 'cmake -S examples -B built -G Ninja; cmake --build built; built/01_solver/01_solver'
echo 'five packages in a fresh root'
