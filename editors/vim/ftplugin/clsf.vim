" What holds in CL programs: `:make` checks them, and a comment begins with two dollar signs.
if exists("b:did_ftplugin") | finish | endif
let b:did_ftplugin = 1
compiler clsmith
setlocal commentstring=$$\ %s
let b:undo_ftplugin = "setlocal commentstring< makeprg< errorformat<"
