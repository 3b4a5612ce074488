@echo off
rem Corrects a CLSF file and posts it: clsmith-hook.bat "C:\work\part.cls"
rem Change the three paths; %~dpn1.nc is the NC program beside the export. Written for cmd.exe; not tested on Windows.
setlocal DisableDelayedExpansion
set "CLSMITH=C:\clsmith\clsmith.exe"
set "RECIPES=S:\cam\clsmith\recipes.yaml"
set "POST=C:\posts\mypost.exe"

if "%~1"=="" (
    echo usage: %~nx0 PROGRAM.cls 1>&2
    exit /b 2
)
"%CLSMITH%" hook --select "%RECIPES%" --log "S:\cam\clsmith\hook.jsonl" --timeout 600 "%~1" -- "%POST%" -o "%~dpn1.nc" {}
exit /b %ERRORLEVEL%
