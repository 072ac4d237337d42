#!/usr/bin/env bash
# `dev` among stand-ins for dpkg, apt, sudo, cmake and ninja: when it installs, what it asks for, what it prints, and how it
# ends. The stand-ins write down how they were called.
set -euo pipefail
script=${1:?usage: dev_test.sh DEV}
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
chmod 755 "$place"
cp "$script" "$place/dev"
mkdir "$place/bin" "$place/few"
calls=$place/calls

stand_in() {  # NAME <<< BODY
  { printf '#!/bin/bash\n'; cat; } >"$place/bin/$1"
  chmod 755 "$place/bin/$1"
}
# Packages named in $ABSENT are not installed.
stand_in dpkg-query <<'BODY'
for package; do
  if [[ $package != -* && " $ABSENT " != *" $package "* ]]; then echo "installed $package"; fi
done
BODY
stand_in apt-get <<BODY
echo "apt-get as \$(id -u) \${DEBIAN_FRONTEND-interactive} \$*" >>"$calls"
echo "apt's own chatter"
[[ \$* != *" install "* || -z \$APT_FAILS ]]
BODY
stand_in sudo <<BODY
echo "sudo \$1" >>"$calls"
[[ -z \$SUDO_FAILS ]] && "\$@"
BODY
stand_in ninja <<'BODY'
if [[ -z $STALE ]]; then echo 'ninja: no work to do.'; else echo '[1/1] would compile'; fi
BODY
stand_in cmake <<BODY
echo "cmake \$*" >>"$calls"
echo "compiler's own chatter"
[[ -z \$BUILD_FAILS ]]
BODY
stand_in ctest <<BODY
echo "ctest in \${TMPDIR-a disk}: \$*" >>"$calls"
mkdir -p "\$2/Testing/Temporary"
printf '%s\n' "\$LOG" >"\$2/Testing/Temporary/LastTest.log"
[[ \$LOG != *FAILED* ]] && exit 0
printf '7:lang_test.shard_1\n9:house.rooms\n' >"\$2/Testing/Temporary/LastTestsFailed.log"
exit 8
BODY
stand_in df <<<'printf "Avail\n%s\n" "$FREE"'
unset ZWANG_SKIP_SETUP ZWANG_LONG TMPDIR
export FREE=3000000 ABSENT='' APT_FAILS='' SUDO_FAILS='' STALE='' BUILD_FAILS='' LOG=''

failed=0
complain() {
  printf 'FAIL: %s: %s\n--- stdout\n%s\n--- stderr\n%s\n--- calls\n%s\n' "$name" "$1" "$out" "$err" "$called"
  failed=1
}
# try NAME STATUS COMMAND...: leaves out, err, called
try() {
  name=$1
  local status=0 wanted=$2
  shift 2
  : >"$calls"
  chmod 666 "$calls"
  PATH=${path:-$place/bin:/usr/bin:/bin} "$@" >"$place/out" 2>"$place/err" </dev/null || status=$?
  out=$(<"$place/out") err=$(<"$place/err") called=$(<"$calls")
  if ((status != wanted)); then complain "ended with $status instead of $wanted"; fi
}
is() { if [[ $1 != "$2" ]]; then complain "\`$1\` is not \`$2\`"; fi; }
has() { if [[ $1 != *"$2"* ]]; then complain "\`$2\` does not occur"; fi; }
lacks() { if [[ $1 == *"$2"* ]]; then complain "\`$2\` occurs"; fi; }

try 'help' 0 "$place/dev" help
has "$out" './dev COMMAND'
try 'unknown command' 2 "$place/dev" frobnicate
has "$err" 'frobnicate'

try 'nothing is missing' 0 "$place/dev" setup
is "$called" ''
ABSENT='libeigen3-dev g++' ZWANG_SKIP_SETUP=1 try 'set-up is switched off' 0 "$place/dev" setup
is "$called" ''

if ((EUID == 0)); then
  ABSENT='libeigen3-dev g++' try 'two are missing, as root' 0 "$place/dev" setup
  has "$called" 'apt-get as 0 noninteractive'
  has "$called" ' update'
  has "$called" 'install -y --no-install-recommends g++ libeigen3-dev'
  lacks "$called" 'sudo'
  lacks "$called" 'cmake '
  is "$out" ''
  lacks "$err" 'chatter'
  ABSENT='g++' APT_FAILS=1 try 'apt fails' 2 "$place/dev" setup
  has "$err" 'apt-get install g++'
  has "$err" "apt's own chatter"
  other_user=(setpriv --reuid=65534 --regid=65534 --clear-groups)
else
  other_user=()
fi

ABSENT='g++' try 'a user with sudo' 0 "${other_user[@]}" "$place/dev" setup
has "$called" 'sudo env'
has "$called" 'noninteractive'
has "$called" 'install -y --no-install-recommends g++'
ABSENT='g++' SUDO_FAILS=1 try 'a user whom sudo refuses' 2 "${other_user[@]}" "$place/dev" setup
has "$err" 'as root, run'

for tool in bash cat dirname env mkdir mktemp readlink rm setpriv; do
  ln -s "$(command -v "$tool")" "$place/few/$tool"
done
path=$place/few try 'no dpkg' 2 "$place/dev" setup
has "$err" 'not Debian'
ln -s "$place/bin/dpkg-query" "$place/bin/apt-get" "$place/few/"
ABSENT='g++' path=$place/few try 'a user without sudo' 2 "${other_user[@]}" "$place/dev" setup
if ((${#other_user[@]} || EUID)); then has "$err" 'neither root nor sudo'; fi
is "$called" ''

# A build that is in place, and a program that shows its arguments.
mkdir -p "$place/build/release"
touch "$place/CMakePresets.json" "$place/build/release/build.ninja"
printf 'CMAKE_HOME_DIRECTORY:INTERNAL=%s\n' "$place" >"$place/build/release/CMakeCache.txt"
touch -d '+1 minute' "$place/build/release/.configured"
printf '#!/bin/bash\nprintf "<%%s>" "$@"\nexit 1\n' >"$place/build/release/zwang"
chmod 755 "$place/build/release/zwang"

try 'run with a fresh build' 1 "$place/dev" run a.yaml -p 'push=30 N'
is "$out" '<run><a.yaml><-p><push=30 N>'
is "$err" ''
is "$called" ''
STALE=1 try 'run with a stale build' 1 "$place/dev" run a.yaml
is "$out" '<run><a.yaml>'
has "$called" 'cmake --build'
lacks "$err" 'chatter'
STALE=1 BUILD_FAILS=1 try 'run when the build fails' 2 "$place/dev" run a.yaml
is "$out" ''
has "$err" "compiler's own chatter"

try 'all tests' 0 "$place/dev" test
has "$called" "-C shards -LE ^single"
if [[ -w /dev/shm ]] && ! grep -q '^[^ ]* /dev/shm .*noexec' /proc/mounts; then
  has "$called" 'ctest in /dev/shm/zwang_'
  folder=${called#*ctest in } folder=${folder%%:*}
  if [[ -e $folder ]]; then complain "$folder is left"; fi
fi
FREE=1000000 try 'tests with little memory' 0 "$place/dev" test
has "$called" 'ctest in a disk'
TMPDIR=$place try 'tests with a folder of the user' 0 "$place/dev" test
has "$called" "ctest in $place:"
try 'tests by their names' 0 "$place/dev" test -R Tick
has "$called" '-R Tick'
lacks "$called" 'shards'
export LOG='[ RUN      ] Tick.Good
[       OK ] Tick.Good (1 ms)
[ RUN      ] All/Tick.Bad/3
[  FAILED  ] All/Tick.Bad/3, where GetParam() = 3 (2 ms)
[  FAILED  ] All/Tick.Bad/3, where GetParam() = 3
[  FAILED  ] 1 test, listed below:
<end of output>
[ RUN      ] Tick.EndsTheProcess
<end of output>'
try 'a test fails beside others in one process' 1 "$place/dev" test
has "$err" 'release failed: house.rooms All/Tick.Bad/3 Tick.EndsTheProcess (did not come to its end)'
export LOG='3/9 Test: house.rooms
Test time =   0.50 sec
4/9 Test: lang_test.shard_1
[       OK ] Tick.Slow (2345 ms)
[       OK ] Tick.Quick (4 ms)
Test time =   2.60 sec'
try 'the slowest tests' 0 "$place/dev" test
has "$err" '2.3 s  Tick.Slow
     0.5 s  house.rooms
     0.0 s  Tick.Quick
'
export LOG=''
mkdir -p "$place/build/asan" "$place/tests/fuzz/corpus"
for target in task condition robot scene scenario study; do ln -sf /bin/true "$place/build/asan/fuzz_$target"; done
try 'all' 0 "$place/dev" test --all
has "$called" "$place/build/tsan"
has "$err" 'fuzzing scenario for 10 s'
ZWANG_MOST_PROCESSOR_SECONDS=-1 try 'all in more than its time' 1 "$place/dev" test --all
has "$err" 'time failed'

# The pictures: made by node from the program and the page's parts; too many bytes are refused.
mkdir -p "$place/docs/pictures" "$place/web"
stand_in node <<BODY
echo "node \$*" >>"$calls"
head -c "\${PICTURE_BYTES:-10}" /dev/zero | tee "\$4/a.svg" "\$4/a.webp" >"\$4/a.png"
BODY
for tool in npm chromium; do stand_in "$tool" <<<"echo \"$tool \$*\" >>\"$calls\""; done
ABSENT='chromium webp' try 'pictures' 0 "$place/dev" pictures
has "$called" 'install -y --no-install-recommends chromium webp'
has "$called" "node $place/docs/pictures/make.mjs $place/build/release/zwang $place/specs $place/docs/pictures $place/bin/chromium"
has "$err" '30 bytes'
PICTURE_BYTES=700000 try 'pictures that are too large' 2 "$place/dev" pictures
has "$err" 'more than 1500000'

touch -d '+2 minutes' "$place/CMakePresets.json"
try 'run after the presets changed' 1 "$place/dev" run a.yaml
has "$called" "-D ZWANG_BUILD_TESTS=ON -D ZWANG_PYTHON=ON -D ZWANG_CONNECT=ON -S $place --preset release"
printf 'CMAKE_HOME_DIRECTORY:INTERNAL=/elsewhere\n' >"$place/build/release/CMakeCache.txt"
try 'run in a checkout that was moved' 1 "$place/dev" run a.yaml
has "$called" '--fresh'

touch -d '-1 minute' "$place/CMakePresets.json"
# Who runs a task needs nothing that only tests are built with; who tests gets it without a second folder.
rm -rf "$place/build/release/CMakeCache.txt" "$place/build/release/.configured"
ABSENT='libgtest-dev' try 'run where nothing was ever built' 1 "$place/dev" run a.yaml
lacks "$called" 'apt-get'
has "$called" '-D ZWANG_BUILD_TESTS=OFF -D ZWANG_BUILD_BENCH=OFF'
try 'run once more' 1 "$place/dev" run a.yaml
is "$called" ''
ABSENT='libgtest-dev' try 'test after run' 0 "$place/dev" test
has "$called" 'install -y --no-install-recommends libgtest-dev'
has "$called" '-D ZWANG_BUILD_TESTS=ON'
try 'run after test' 1 "$place/dev" run a.yaml
is "$called" ''

exit "$failed"
