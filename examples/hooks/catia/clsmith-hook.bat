@echo off
rem Corrects an APT source and posts it: clsmith-hook.bat "C:\work\part.aptsource"
rem Change the three paths. Written for cmd.exe; not tested on Windows.
setlocal DisableDelayedExpansion
set "CLSMITH=C:\clsmith\clsmith.exe"
set "RECIPES=S:\cam\clsmith\recipes.yaml"
set "POST=C:\posts\mypost.exe"

if "%~1"=="" (
    echo usage: %~nx0 PROGRAM.aptsource 1>&2
    exit /b 2
)
"%CLSMITH%" hook --select "%RECIPES%" --log "S:\cam\clsmith\hook.jsonl" --timeout 600 "%~1" -- "%POST%" -o "%~dpn1.nc" {}
exit /b %ERRORLEVEL%
