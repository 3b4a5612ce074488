@echo off
rem Corrects a CL file of Creo and posts it: clsmith-hook.bat "C:\work\op010.ncl.1"
rem Change the three paths. Written for cmd.exe; not tested on Windows.
setlocal DisableDelayedExpansion
set "CLSMITH=C:\clsmith\clsmith.exe"
set "RECIPES=S:\cam\clsmith\recipes.yaml"
set "POST=C:\posts\mypost.exe"

if "%~1"=="" (
    echo usage: %~nx0 PROGRAM.ncl.1 1>&2
    exit /b 2
)
rem %~dpn1 is the path without the version (.1); the NC program gets .tap behind it.
"%CLSMITH%" hook --select "%RECIPES%" --log "S:\cam\clsmith\hook.jsonl" --timeout 600 "%~1" -- "%POST%" -o "%~dpn1.tap" {}
exit /b %ERRORLEVEL%
