"""Builds one program for this computer; `-t exec` runs it."""

from SCons.Script import AlwaysBuild, Default, DefaultEnvironment

env = DefaultEnvironment()
env.Replace(CC="gcc", CXX="g++", AR="gcc-ar", RANLIB="gcc-ranlib")

program = env.BuildProgram()
Default(program)
AlwaysBuild(env.Alias("exec", program, env.VerboseAction("$SOURCE", "Running $SOURCE")))
