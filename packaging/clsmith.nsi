; The installer for Windows: clsmith with its pages, in a folder that is put on the path of the machine.
;
;   clsmith-...-setup.exe /S /D=C:\clsmith      without questions; /D comes last and has no quotes
;
; scripts/release gives VERSION, VERSION_FOUR, STAGED (what is installed), OUT, SIZE_KB and REMOVAL (what is removed).

Unicode true
Target amd64-unicode
SetCompressor /SOLID lzma
; The same content gives the same bytes: files get the date of their installation.
SetDateSave off
RequestExecutionLevel admin

!include MUI2.nsh
!include LogicLib.nsh
!include WinMessages.nsh

Name "clsmith ${VERSION}"
OutFile "${OUT}"
InstallDir "$PROGRAMFILES64\clsmith"
InstallDirRegKey HKLM "Software\clsmith" "Folder"
VIProductVersion "${VERSION_FOUR}"
VIAddVersionKey ProductName "clsmith"
VIAddVersionKey ProductVersion "${VERSION}"
VIAddVersionKey FileVersion "${VERSION}"
VIAddVersionKey FileDescription "clsmith installer"
VIAddVersionKey LegalCopyright "The clsmith authors; MIT or Apache-2.0"

!insertmacro MUI_PAGE_LICENSE "${STAGED}/LICENSE-MIT"
!insertmacro MUI_PAGE_DIRECTORY
!insertmacro MUI_PAGE_INSTFILES
!insertmacro MUI_UNPAGE_CONFIRM
!insertmacro MUI_UNPAGE_INSTFILES
!insertmacro MUI_LANGUAGE "English"

!define PROGRAMS "Software\Microsoft\Windows\CurrentVersion\Uninstall\clsmith"
!define ENVIRONMENT "SYSTEM\CurrentControlSet\Control\Session Manager\Environment"

; Reads the machine's path into memory of its own, since variables of NSIS end at 1024 characters and a path may not.
; $0: the open key; $2: the value's type; $4: memory that holds `;path;`, with room for one more folder; $1: 0 if all went well.
!macro ReadPath
  StrCpy $4 0
  ; Query and set, in the registry of 64 bits.
  System::Call 'advapi32::RegOpenKeyExW(p 0x80000002, w "${ENVIRONMENT}", i 0, i 0x2011F, *p .r0) i .r1'
  ${If} $1 = 0
    System::Call 'advapi32::RegQueryValueExW(p r0, w "Path", p 0, *i .r2, p 0, *i .r3) i .r1'
    ${If} $1 = 0
      IntOp $5 $3 + 4096
      System::Call 'kernel32::GlobalAlloc(i 0x40, p r5) p .r4'
      System::Call 'kernel32::lstrcpyW(p r4, w ";")'
      IntPtrOp $5 $4 + 2
      System::Call 'advapi32::RegQueryValueExW(p r0, w "Path", p 0, *i .r2, p r5, *i r3) i .r1'
      System::Call 'kernel32::lstrcatW(p r4, w ";")'
    ${EndIf}
  ${EndIf}
!macroend

; Writes the path back, without the `;` in front and at the end that ReadPath put there.
!macro WritePath
  System::Call 'kernel32::lstrlenW(p r4) i .r6'
  IntOp $6 $6 - 1
  IntOp $7 $6 * 2
  IntPtrOp $8 $4 + $7
  System::Call '*$8(&i2 0)'
  IntPtrOp $5 $4 + 2
  ; Bytes of the text behind the first `;`, with the 0 at its end.
  System::Call 'advapi32::RegSetValueExW(p r0, w "Path", i 0, i r2, p r5, i r7) i .r1'
  SendMessage ${HWND_BROADCAST} ${WM_WININICHANGE} 0 "STR:Environment" /TIMEOUT=5000
!macroend

!macro ClosePath
  ${If} $4 P<> 0
    System::Call 'kernel32::GlobalFree(p r4)'
  ${EndIf}
  System::Call 'advapi32::RegCloseKey(p r0)'
!macroend

Function AddToPath
  !insertmacro ReadPath
  ${If} $1 = 0
    StrCpy $9 ";$INSTDIR;"
    System::Call 'shlwapi::StrStrIW(p r4, w r9) p .r8'
    ${If} $8 P= 0
      StrCpy $9 "$INSTDIR;"
      System::Call 'kernel32::lstrcatW(p r4, w r9)'
      !insertmacro WritePath
    ${EndIf}
  ${EndIf}
  !insertmacro ClosePath
  ${If} $1 <> 0
    DetailPrint "The path of the machine could not be changed (error $1): add $INSTDIR by hand."
    SetErrorLevel 3
  ${EndIf}
FunctionEnd

Function un.RemoveFromPath
  !insertmacro ReadPath
  ${If} $1 = 0
    StrCpy $9 ";$INSTDIR;"
    System::Call 'shlwapi::StrStrIW(p r4, w r9) p .r8'
    ${If} $8 P<> 0
      ; `;a;FOLDER;b;` becomes `;a;b;`: what follows moves over `;FOLDER`.
      StrLen $6 $9
      IntOp $6 $6 - 1
      IntOp $6 $6 * 2
      IntPtrOp $9 $8 + $6
      System::Call 'kernel32::lstrlenW(p r9) i .r6'
      IntOp $6 $6 + 1
      IntOp $6 $6 * 2
      System::Call 'ntdll::memmove(p r8, p r9, p r6)'
      !insertmacro WritePath
    ${EndIf}
  ${EndIf}
  !insertmacro ClosePath
FunctionEnd

Section
  SetRegView 64
  SetOutPath "$INSTDIR"
  File /r "${STAGED}/*"
  WriteRegStr HKLM "Software\clsmith" "Folder" "$INSTDIR"
  WriteRegStr HKLM "${PROGRAMS}" "DisplayName" "clsmith"
  WriteRegStr HKLM "${PROGRAMS}" "DisplayVersion" "${VERSION}"
  WriteRegStr HKLM "${PROGRAMS}" "Publisher" "The clsmith authors"
  WriteRegStr HKLM "${PROGRAMS}" "InstallLocation" "$INSTDIR"
  WriteRegStr HKLM "${PROGRAMS}" "UninstallString" '"$INSTDIR\uninstall.exe"'
  WriteRegStr HKLM "${PROGRAMS}" "QuietUninstallString" '"$INSTDIR\uninstall.exe" /S'
  WriteRegDWORD HKLM "${PROGRAMS}" "EstimatedSize" ${SIZE_KB}
  WriteRegDWORD HKLM "${PROGRAMS}" "NoModify" 1
  WriteRegDWORD HKLM "${PROGRAMS}" "NoRepair" 1
  WriteUninstaller "$INSTDIR\uninstall.exe"
  Call AddToPath
SectionEnd

; Only what was installed is removed: what somebody has put into the folder stays.
Section Uninstall
  SetRegView 64
  Call un.RemoveFromPath
  !include "${REMOVAL}"
  Delete "$INSTDIR\uninstall.exe"
  RMDir "$INSTDIR"
  DeleteRegKey HKLM "${PROGRAMS}"
  DeleteRegKey HKLM "Software\clsmith"
SectionEnd
