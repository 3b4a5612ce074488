" Made from the colours of editors/vscode; do not edit (`node editors/make_colors.mjs`).
if exists("b:current_syntax") | finish | endif
syntax case ignore
syntax match clNumber ~\%(\k\|\.\)\@1<![-+]\=\%(\d\+\.\=\d*\|\.\d\+\)\%([ed][-+]\=\d\+\)\=\k\@!~
syntax match clString ~'[^']*'~
syntax match clOperation ~\%(^\s*TOOL PATH\s*/\)\@40<=[^,]*~
syntax match clText ~\%(^\s*\%(N\=\d\+\s\+\)\=\)\@40<=\%(INSERT\|PARTNO\|PPRINT\|REMARK\|TPRINT\)\ze\s*\%(/\|\$\|$\)~
syntax match clCycle ~\%(^\s*\%(N\=\d\+\s\+\)\=\)\@40<=\%(CYCLE\)\ze\s*\%(/\|\$\|$\)~
syntax match clFrame ~\%(^\s*\%(N\=\d\+\s\+\)\=\)\@40<=\%(CAMERA\|MULTAX\|ORIGIN\|ROTABL\|TLAXIS\|TRANS\|CSYS\|MSYS\)\ze\s*\%(/\|\$\|$\)~
syntax match clTool ~\%(^\s*\%(N\=\d\+\s\+\)\=\)\@40<=\%(CUTCOM\|CUTTER\|LOADTL\|TLDATA\|TOOLNO\|TURRET\|LOAD\)\ze\s*\%(/\|\$\|$\)~
syntax match clMotion ~\%(^\s*\%(N\=\d\+\s\+\)\=\)\@40<=\%(HELICAL\|CIRCLE\|GODLTA\|GOHOME\|INDIRV\|MOVARC\|CNTRL\|NURBS\|FROM\|GOTO\|KNOT\)\ze\s*\%(/\|\$\|$\)~
syntax match clStructure ~\%(^\s*\%(N\=\d\+\s\+\)\=\)\@40<=\%(END-OF-PATH\|OPFEATSTART\|OPFEATEND\|TOOL PATH\|CHANNEL\|FEATNO\|UNITS\|FINI\|HEAD\|UNIT\|END\)\ze\s*\%(/\|\$\|$\)~
syntax match clRapid ~\%(^\s*\%(N\=\d\+\s\+\)\=\)\@40<=\%(RAPID\)\ze\s*\%(/\|\$\|$\)~
syntax match clFeed ~\%(^\s*\%(N\=\d\+\s\+\)\=\)\@40<=\%(FEDRAT\|SPINDL\|THREAD\|PITCH\)\ze\s*\%(/\|\$\|$\)~
syntax match clWord ~\%(^\s*\%(N\=\d\+\s\+\)\=\)\@40<=\%(CSI_SET_EXTENSION_LENGTH\|CSI_SET_FLUTE_LENGTH\|CUTCOM_GEOMETRY_TYPE\|LOCAL_ORIGIN\|MOVE_ATTRIB\|FACEMILL\|ARCSLP\|AUTOPS\|AUXFUN\|CLEARP\|CLRSRF\|COOLNT\|COUPLE\|DISPLY\|GOCLER\|INTCOD\|LEADER\|LINTOL\|MACHIN\|MCHTOL\|NOPOST\|OFSTNO\|OPSKIP\|OPSTOP\|OUTTOL\|OVPLOT\|PIVOTZ\|PLUNGE\|PPWORD\|PREFUN\|RETRCT\|REWIND\|SAFETY\|SELCTL\|SELECT\|SLOWDN\|SMOOTH\|SPLPNT\|SWITCH\|TRACUT\|TRNTYP\|VERIFY\|BREAK\|CHECK\|CLAMP\|DELAY\|FLUSH\|HELIX\|INTOL\|MFGNO\|PAINT\|PPFUN\|RESET\|SEQNO\|SETUP\|SHIFT\|TMARK\|WCORN\|MODE\|PSIS\|STOP\|TOOL\|BOX\|SET\|SYN\)\ze\s*\%(/\|\$\|$\)~
syntax match clMinor ~[/,]\s*\zs\%(BRKCHP\|INCHES\|INVERS\|MAXRPM\|PERMIN\|PERREV\|CSINK\|DRILL\|FLOOD\|RIGHT\|BORE\|CCLW\|DEEP\|FACE\|LEFT\|MIST\|MMPM\|MMPR\|REAM\|THRU\|TOOL\|CLW\|IPM\|IPR\|OFF\|RPM\|SFM\|SMM\|TAP\|MM\|ON\)\ze\s*\%(,\|\$\|$\)~
syntax match clSequence ~^\s*\zsN\=\d\+\ze\s\+\a~
syntax match clContinuation ~\$\s*$~
syntax match clRemark ~^\s*\%(REMARK\|PPRINT\)\>.*$~
syntax match clRemark ~\$\$.*$~
highlight default link clText Comment
highlight default link clCycle Function
highlight default link clFrame PreProc
highlight default link clTool Identifier
highlight default link clMotion Statement
highlight default link clStructure Title
highlight default link clRapid Special
highlight default link clFeed Type
highlight default link clWord Macro
highlight default link clMinor Constant
highlight default link clNumber Number
highlight default link clString String
highlight default link clOperation Function
highlight default link clSequence LineNr
highlight default link clContinuation SpecialChar
highlight default link clRemark Comment
let b:current_syntax = "clsf"
