# Sourced in the root folder by what builds: progress with times, and a compiler cache that serves any checkout, with
# what it needs to cache what uses precompiled headers.
export NINJA_STATUS='[%f/%t, %es] '
export CCACHE_BASEDIR=${CCACHE_BASEDIR:-$PWD} CCACHE_NOHASHDIR=1
export CCACHE_SLOPPINESS=${CCACHE_SLOPPINESS:-pch_defines,time_macros}
