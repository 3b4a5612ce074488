;;; clsf-words.el --- the words of CL programs -*- lexical-binding: t -*-
;; Made from the colours of editors/vscode; do not edit (`node editors/make_colors.mjs`).

(defconst clsf-major-words
  '(
    (font-lock-comment-face "INSERT" "PARTNO" "PPRINT" "REMARK" "TPRINT")
    (font-lock-function-name-face "CYCLE")
    (font-lock-preprocessor-face "CAMERA" "MULTAX" "ORIGIN" "ROTABL" "TLAXIS" "TRANS" "CSYS" "MSYS")
    (font-lock-variable-name-face "CUTCOM" "CUTTER" "LOADTL" "TLDATA" "TOOLNO" "TURRET" "LOAD")
    (font-lock-keyword-face "HELICAL" "CIRCLE" "GODLTA" "GOHOME" "INDIRV" "MOVARC" "CNTRL" "NURBS" "FROM" "GOTO" "KNOT")
    (font-lock-doc-face "END-OF-PATH" "OPFEATSTART" "OPFEATEND" "TOOL PATH" "CHANNEL" "FEATNO" "UNITS" "FINI" "HEAD" "UNIT" "END")
    (font-lock-warning-face "RAPID")
    (font-lock-type-face "FEDRAT" "SPINDL" "THREAD" "PITCH")
    (font-lock-builtin-face "CSI_SET_EXTENSION_LENGTH" "CSI_SET_FLUTE_LENGTH" "CUTCOM_GEOMETRY_TYPE" "LOCAL_ORIGIN" "MOVE_ATTRIB" "FACEMILL" "ARCSLP" "AUTOPS" "AUXFUN" "CLEARP" "CLRSRF" "COOLNT" "COUPLE" "DISPLY" "GOCLER" "INTCOD" "LEADER" "LINTOL" "MACHIN" "MCHTOL" "NOPOST" "OFSTNO" "OPSKIP" "OPSTOP" "OUTTOL" "OVPLOT" "PIVOTZ" "PLUNGE" "PPWORD" "PREFUN" "RETRCT" "REWIND" "SAFETY" "SELCTL" "SELECT" "SLOWDN" "SMOOTH" "SPLPNT" "SWITCH" "TRACUT" "TRNTYP" "VERIFY" "BREAK" "CHECK" "CLAMP" "DELAY" "FLUSH" "HELIX" "INTOL" "MFGNO" "PAINT" "PPFUN" "RESET" "SEQNO" "SETUP" "SHIFT" "TMARK" "WCORN" "MODE" "PSIS" "STOP" "TOOL" "BOX" "SET" "SYN"))
  "Major words by the face that they are shown in.")

(defconst clsf-minor-words
  '("BRKCHP" "INCHES" "INVERS" "MAXRPM" "PERMIN" "PERREV" "CSINK" "DRILL" "FLOOD" "RIGHT" "BORE" "CCLW" "DEEP" "FACE" "LEFT" "MIST" "MMPM" "MMPR" "REAM" "THRU" "TOOL" "CLW" "IPM" "IPR" "OFF" "RPM" "SFM" "SMM" "TAP" "MM" "ON")
  "Words behind a major one.")

(provide 'clsf-words)
