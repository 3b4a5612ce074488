@echo off
rem Corrects a CLSF file and posts it: clsmith-hook.bat "C:\work\part.cls"
rem Ends with the post's exit code; see README.md for the others. The same file serves every workstation: what differs is in
rem environment variables of the machine, and stands here only where they are not set.
setlocal DisableDelayedExpansion
if not defined CLSMITH_EXE set "CLSMITH_EXE=clsmith.exe"
if not defined CLSMITH_RECIPES set "CLSMITH_RECIPES=S:\cam\clsmith\recipes.yaml"
if not defined CLSMITH_LOG set "CLSMITH_LOG=S:\cam\clsmith\hook.jsonl"
if not defined CLSMITH_POST set "CLSMITH_POST=C:\posts\mypost.exe"

if "%~1"=="" (
    echo usage: %~nx0 PROGRAM.cls 1>&2
    exit /b 2
)
rem %~dpn1 is the path without its ending.
"%CLSMITH_EXE%" hook --select "%CLSMITH_RECIPES%" --log "%CLSMITH_LOG%" --timeout 600 "%~1" -- "%CLSMITH_POST%" -o "%~dpn1.nc" {}
exit /b %ERRORLEVEL%
